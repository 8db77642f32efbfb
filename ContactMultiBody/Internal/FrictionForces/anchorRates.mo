within ContactMultiBody.Internal.FrictionForces;
pure function anchorRates "Rates of the stretches of all pairs"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force normalForce[:, :] "Normal forces of the points";
  input Modelica.Units.SI.Position stretch[size(normalForce, 1), 3] "Way of each pair since its anchor was set";
  input Modelica.Units.SI.Velocity sliding[size(normalForce, 1), 3] "Tangential velocity of each pair";
  input Real meanNormal[size(normalForce, 1), 3](each unit="1") "Unit normal of each pair";
  input Modelica.Units.SI.AngularVelocity spin[size(normalForce, 1)] "Mean angular velocity about the normal";
  input Modelica.Units.SI.TranslationalSpringConstant stiffness[size(normalForce, 1)] "Stiffness of each static spring";
  input Real mu[size(normalForce, 1)](each unit="1") "Coefficient of friction of each pair";
  input Modelica.Units.SI.Time relaxationTime "Time in which an anchor that holds nothing is forgotten";
  output Modelica.Units.SI.Velocity rate[size(normalForce, 1), 3] "Derivatives of the stretches";
algorithm
  for i in 1:size(normalForce, 1) loop
    rate[i, :] := Friction.anchorRate(
      sum(normalForce[i, k] for k in 1:size(normalForce, 2)),
      stretch[i, :],
      sliding[i, :],
      meanNormal[i, :],
      spin[i],
      stiffness[i],
      mu[i],
      relaxationTime);
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Applies <a href=\"modelica://ContactMultiBody.Friction.anchorRate\">Friction.anchorRate</a> to each pair.</p>
</html>"));
end anchorRates;
