within Modelica.Units.Icons;
partial function Conversion "Icon of a function that converts units"
  extends Modelica.Icons.Function;
  annotation (Documentation(info="<html><p>The icon of functions that convert units.</p></html>"));
end Conversion;
