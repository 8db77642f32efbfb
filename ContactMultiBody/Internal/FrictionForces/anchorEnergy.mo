within ContactMultiBody.Internal.FrictionForces;
pure function anchorEnergy "Energy stored in the static springs of all pairs"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position anchor[:, 6] "Stretch of the patch of each pair";
  input Modelica.Units.SI.TranslationalSpringConstant stiffness[size(anchor, 1)] "Stiffness of each static spring";
  output Modelica.Units.SI.Energy energy "Stored energy";
algorithm
  energy := 0;
  for i in 1:size(anchor, 1) loop
    energy := energy + stiffness[i]*(anchor[i, :]*anchor[i, :])/2;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Half stiffness times stretch squared.</p>
</html>"));
end anchorEnergy;
