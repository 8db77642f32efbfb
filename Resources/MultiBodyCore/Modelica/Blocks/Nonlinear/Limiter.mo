within Modelica.Blocks.Nonlinear;
block Limiter "Output between two limits"
  parameter Real uMax(start=1) "Upper limit";
  parameter Real uMin=-uMax "Lower limit";
  parameter Boolean strict=false "= true, if the limits cause no events" annotation (Dialog(tab="Advanced"));
  parameter Modelica.Blocks.Types.LimiterHomotopy homotopyType=Modelica.Blocks.Types.LimiterHomotopy.Linear "Accepted; without effect"
    annotation (Dialog(tab="Advanced"));
  extends Modelica.Blocks.Interfaces.SISO;
equation
  assert(uMax >= uMin, "Limiter: uMax must not be smaller than uMin; exchange the limits");
  y = if strict then smooth(0, noEvent(if u > uMax then uMax else if u < uMin then uMin else u)) else smooth(0, if u > uMax then uMax else if u
     < uMin then uMin else u);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,-60},{-40,-60},{40,60},{80,60}}, color={0,0,160}, thickness=0.5)}),
    Documentation(info="<html>
<p>The output is the input, but at least <code>uMin</code> and at most <code>uMax</code>.</p></html>"));
end Limiter;
