within Modelica.Blocks.Continuous;
block Der "Derivative of the input"
  extends Modelica.Blocks.Interfaces.SISO;
equation
  y = der(u);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Text(extent={{-90,60},{90,-60}}, textColor={60,60,60}, textString="d/dt")}),
    Documentation(info="<html>
<p>The input must be differentiable.</p></html>"));
end Der;
