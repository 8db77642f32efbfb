within ContactMultiBody.Internal.NormalForces;
pure function springEnergy "Energy stored in the normal springs of all points"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length depth[:, :] "Penetration depths";
  input Real weight[size(depth, 1), size(depth, 2)](each unit="1") "Weights of the points";
  input Real stiffness[size(depth, 1)] "Stiffness of each pair";
  input Real exponent(unit="1") "Exponent of the depth";
  output Modelica.Units.SI.Energy energy "Stored energy";
algorithm
  energy := 0;
  for i in 1:size(depth, 1) loop
    for k in 1:size(depth, 2) loop
      energy := energy + weight[i, k]*stiffness[i]*depth[i, k]^(exponent + 1)/(exponent + 1);
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Integral of K x<sup>n</sup> over the depth.</p>
</html>"));
end springEnergy;
