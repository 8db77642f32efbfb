within Modelica.Blocks.Math;
block Abs "Absolute value"
  extends Modelica.Blocks.Interfaces.SISO;
  parameter Boolean generateEvent=false "= true, if the change of sign is an event";
equation
  y = if generateEvent then (if u >= 0 then u else -u) else noEvent(if u >= 0 then u else -u);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-70,60},{0,-40},{70,60}}, color={0,0,160}, thickness=0.5)}),
    Documentation(info="<html>
<p><code>y = abs(u)</code>.</p></html>"));
end Abs;
