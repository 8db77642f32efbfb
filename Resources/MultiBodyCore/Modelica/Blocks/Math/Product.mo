within Modelica.Blocks.Math;
block Product "Product of two inputs"
  extends Modelica.Blocks.Interfaces.SI2SO;
equation
  y = u1*u2;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Text(extent={{-90,60},{90,-60}}, textColor={60,60,60}, textString="x")}),
    Documentation(info="<html>
<p><code>y = u1*u2</code>.</p></html>"));
end Product;
