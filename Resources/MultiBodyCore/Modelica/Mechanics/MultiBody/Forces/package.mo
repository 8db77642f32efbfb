within Modelica.Mechanics.MultiBody;
package Forces "Forces and torques"
  extends Modelica.Icons.SourcesPackage;
  annotation (Documentation(info="<html><p>Elements that apply forces and torques to frames.</p></html>"));
end Forces;
