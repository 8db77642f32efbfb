within ContactMultiBody.Actuators;
package Interfaces "Base classes of drives"
  extends Modelica.Icons.InterfacesPackage;

  annotation (Documentation(info="<html>
<p>Extend these for drives of your own: the one equation that is missing is that of the torque or force.</p>
</html>"));
end Interfaces;
