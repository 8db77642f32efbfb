within ContactMultiBody.Internal.FrictionForces;
pure function anchoredForces "Forces of all points with anchored friction"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force normalForce[:, :] "Normal forces";
  input Real normal[size(normalForce, 1), size(normalForce, 2), 3](each unit="1") "Normals";
  input Real meanNormal[size(normalForce, 1), 3](each unit="1") "Unit normal of each pair";
  input Modelica.Units.SI.Velocity sliding[size(normalForce, 1), 3] "Tangential velocity of each pair";
  input Modelica.Units.SI.Position stretch[size(normalForce, 1), 3] "Way of each pair since its anchor was set";
  input Modelica.Units.SI.TranslationalSpringConstant stiffness[size(normalForce, 1)] "Stiffness of each static spring";
  input Modelica.Units.SI.Time dampingTime "Damping of the static springs by their stiffness";
  input Real mu[size(normalForce, 1)](each unit="1") "Coefficient of friction of each pair";
  output Modelica.Units.SI.Force force[size(normalForce, 1), size(normalForce, 2), 3] "Forces on the first bodies";
protected
  Modelica.Units.SI.Force total "Sum of the normal forces of a pair";
  Modelica.Units.SI.Force tangential[3] "Friction force of a pair";
algorithm
  for i in 1:size(normalForce, 1) loop
    total := sum(normalForce[i, k] for k in 1:size(normalForce, 2));
    tangential := Friction.anchoredForce(
      total,
      stretch[i, :] - (stretch[i, :]*meanNormal[i, :])*meanNormal[i, :],
      sliding[i, :],
      stiffness[i],
      stiffness[i]*dampingTime,
      mu[i]);
    for k in 1:size(normalForce, 2) loop
      force[i, k, :] := normalForce[i, k]*normal[i, k, :] + (if total > 0 then normalForce[i, k]/total else 0)*tangential;
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>The friction force of a pair acts at its points in proportion to their normal forces.</p>
</html>"));
end anchoredForces;
