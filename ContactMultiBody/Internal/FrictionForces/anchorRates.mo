within ContactMultiBody.Internal.FrictionForces;
pure function anchorRates "Rates of the anchors of all pairs"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force normalForce[:, :] "Normal forces";
  input Real normal[size(normalForce, 1), size(normalForce, 2), 3](each unit="1") "Normals";
  input Modelica.Units.SI.Position point[size(normalForce, 1), size(normalForce, 2), 3] "Contact points";
  input Modelica.Units.SI.Velocity velocity[size(normalForce, 1), size(normalForce, 2), 3] "Relative velocities";
  input Modelica.Units.SI.Position anchor[size(normalForce, 1), 6] "Stretch of the patch of each pair";
  input Modelica.Units.SI.AngularVelocity w_0[:, 3] "Angular velocities of the bodies, in world axes";
  input Integer pairs[size(normalForce, 1), 2] "Bodies of each pair";
  input Modelica.Units.SI.TranslationalSpringConstant stiffness[size(normalForce, 1)] "Stiffness of each static spring";
  input Real muStatic[size(normalForce, 1)](each unit="1") "Coefficients of static friction";
  input Real muDynamic[size(normalForce, 1)](each unit="1") "Coefficients of sliding friction";
  input Modelica.Units.SI.Velocity limitSpeed "Speed that separates static from sliding friction";
  input Modelica.Units.SI.Time dampingTime "Damping of the static springs by their stiffness";
  input Modelica.Units.SI.Time relaxationTime "Time in which an anchor that holds nothing is forgotten";
  output Modelica.Units.SI.Velocity rate[size(normalForce, 1), 6] "Derivatives of the stretches";
protected
  Modelica.Units.SI.Force tangential[size(normalForce, 2), 3] "Friction forces of a pair";
  Modelica.Units.SI.Velocity patchRate[6] "Derivative of the stretch of a pair";
algorithm
  tangential := zeros(size(normalForce, 2), 3);
  patchRate := zeros(6);
  for i in 1:size(normalForce, 1) loop
    (tangential,patchRate) := Friction.anchoredPatch(
      normalForce[i, :],
      normal[i, :, :],
      point[i, :, :],
      velocity[i, :, :],
      anchor[i, :],
      (w_0[pairs[i, 1], :] + w_0[pairs[i, 2], :])/2,
      stiffness[i],
      muStatic[i],
      muDynamic[i],
      limitSpeed,
      dampingTime,
      relaxationTime);
    rate[i, :] := patchRate;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Rates by <a href=\"modelica://ContactMultiBody.Friction.anchoredPatch\">Friction.anchoredPatch</a>, which gives the forces too.</p>
</html>"));
end anchorRates;
