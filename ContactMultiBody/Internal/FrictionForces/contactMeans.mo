within ContactMultiBody.Internal.FrictionForces;
pure function contactMeans "Normal, sliding velocity, spin and coefficient of friction of each pair as a whole"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force normalForce[:, :] "Normal forces";
  input Real normal[size(normalForce, 1), size(normalForce, 2), 3](each unit="1") "Normals";
  input Modelica.Units.SI.Velocity velocity[size(normalForce, 1), size(normalForce, 2), 3] "Relative velocities";
  input Modelica.Units.SI.AngularVelocity w_0[:, 3] "Angular velocities of the bodies, in world axes";
  input Integer pairs[size(normalForce, 1), 2] "Bodies of each pair";
  input Real muStatic[size(normalForce, 1)](each unit="1") "Coefficients of static friction";
  input Real muDynamic[size(normalForce, 1)](each unit="1") "Coefficients of sliding friction";
  input Modelica.Units.SI.Velocity limitSpeed "Speed that separates sticking from sliding";
  output Real meanNormal[size(normalForce, 1), 3](each unit="1") "Unit normal, weighted by force";
  output Modelica.Units.SI.Velocity sliding[size(normalForce, 1), 3] "Tangential velocity, weighted by force";
  output Modelica.Units.SI.AngularVelocity spin[size(normalForce, 1)] "Mean angular velocity of the bodies about the normal";
  output Real mu[size(normalForce, 1)](each unit="1") "Coefficient of friction at the present speed";
protected
  Modelica.Units.SI.Force total "Sum of the normal forces";
  Real v[3](each unit="m/s") "Mean velocity";
  Real e[3](each unit="1") "Mean normal";
algorithm
  for i in 1:size(normalForce, 1) loop
    total := sum(normalForce[i, k] for k in 1:size(normalForce, 2));
    e := normal[i, 1, :];
    v := velocity[i, 1, :];
    for k in 2:size(normalForce, 2) loop
      e := e + (if total > 0 then normalForce[i, k]/total else 0)*(normal[i, k, :] - normal[i, 1, :]);
      v := v + (if total > 0 then normalForce[i, k]/total else 0)*(velocity[i, k, :] - velocity[i, 1, :]);
    end for;
    e := e/sqrt(e*e + Modelica.Constants.small);
    v := v - (v*e)*e;
    meanNormal[i, :] := e;
    sliding[i, :] := v;
    spin[i] := (w_0[pairs[i, 1], :] + w_0[pairs[i, 2], :])*e/2;
    mu[i] := Friction.stribeck(sqrt(v*v), muStatic[i], muDynamic[i], limitSpeed);
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Means weighted by the normal forces; before bodies touch, those of the points closest to each other.</p>
</html>"));
end contactMeans;
