within ContactMultiBody;
package Joints "Joints that the Standard Library's MultiBody has not"
  extends Modelica.Icons.Package;

  annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-80,40},{-20,-40}}, lineColor={0,0,0}, fillColor={192,192,192}, fillPattern=FillPattern.HorizontalCylinder),
        Rectangle(extent={{20,40},{80,-40}}, lineColor={0,0,0}, fillColor={192,192,192}, fillPattern=FillPattern.HorizontalCylinder),
        Rectangle(extent={{-20,10},{20,-10}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>Used and connected as those of Modelica.Mechanics.MultiBody.Joints; couplings make the axis of one joint follow that of another.</p>
</html>"));
end Joints;
