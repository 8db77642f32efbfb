within ContactMultiBody.Internal.FreeBodies;
pure function accelerations "Newton's equations of equal free bodies"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Mass m "Mass of each body";
  input Modelica.Units.SI.Acceleration gravity[3] "Acceleration of gravity, in world axes";
  input Modelica.Units.SI.Force force[:, 3] "Forces, in world axes; further rows are not used";
  input Integer count "Number of bodies";
  output Modelica.Units.SI.Acceleration a[count, 3] "Accelerations of the centres of mass, in world axes";
algorithm
  for i in 1:count loop
    for k in 1:3 loop
      a[i, k] := force[i, k]/m + gravity[k];
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>m a = force + m gravity.</p>
</html>"));
end accelerations;
