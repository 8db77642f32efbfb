within Modelica.Blocks;
package Icons "Icons of blocks"
  extends Modelica.Icons.IconsPackage;
  annotation (Documentation(info="<html><p>Base classes of the blocks that give an icon, and nothing else.</p></html>"));
end Icons;
