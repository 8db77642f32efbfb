within Modelica.Icons;
partial class ReleaseNotes "Icon of a class that holds release notes"
  extends Modelica.Icons.Information;
  annotation (Documentation(info="<html><p>The icon of classes that hold release notes.</p></html>"));
end ReleaseNotes;
