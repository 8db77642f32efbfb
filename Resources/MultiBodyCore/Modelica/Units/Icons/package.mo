within Modelica.Units;
package Icons "Icons of the unit packages"
  extends Modelica.Icons.IconsPackage;
  annotation (Documentation(info="<html><p>Icons of the unit packages.</p></html>"));
end Icons;
