within ContactMultiBody.Internal.Kinematics;
pure function pairApproachSpeeds "One approach speed of each pair from those of its points"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Velocity speed[:, :] "Approach speeds of the points";
  input Real weight[size(speed, 1), size(speed, 2)](each unit="1") "Weights of the points";
  output Modelica.Units.SI.Velocity pairSpeed[size(speed, 1)] "Approach speeds of the pairs";
protected
  Real total(unit="1") "Sum of the weights of a pair";
algorithm
  for i in 1:size(speed, 1) loop
    total := sum(weight[i, k] for k in 1:size(speed, 2));
    pairSpeed[i] := if total > 0 then sum(weight[i, k]*speed[i, k] for k in 1:size(speed, 2))/total else speed[i, 1];
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Mean by weight; before bodies touch, the speed at the points closest to each other, which the engine puts first.</p>
</html>"));
end pairApproachSpeeds;
