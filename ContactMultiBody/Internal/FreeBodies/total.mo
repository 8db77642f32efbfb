within ContactMultiBody.Internal.FreeBodies;
pure function total "Sum of many energies"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Energy energy[:] "Energies";
  output Modelica.Units.SI.Energy result "Their sum";
algorithm
  result := 0;
  for i in 1:size(energy, 1) loop
    result := result + energy[i];
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>As the built-in <code>sum</code>, which tools may write out as one expression nested as deep as there are elements.</p>
</html>"));
end total;
