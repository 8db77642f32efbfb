within ContactMultiBody.Internal.FrictionForces;
pure function anchorEnergy "Energy stored in the static springs of all pairs"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position stretch[:, 3] "Way of each pair since its anchor was set";
  input Modelica.Units.SI.TranslationalSpringConstant stiffness[size(stretch, 1)] "Stiffness of each static spring";
  output Modelica.Units.SI.Energy energy "Stored energy";
algorithm
  energy := 0;
  for i in 1:size(stretch, 1) loop
    energy := energy + stiffness[i]*(stretch[i, :]*stretch[i, :])/2;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Half stiffness times stretch squared.</p>
</html>"));
end anchorEnergy;
