within Modelica.Icons;
partial class References "Icon of a class that lists literature"
  extends Modelica.Icons.Information;
  annotation (Documentation(info="<html><p>The icon of classes that list literature.</p></html>"));
end References;
