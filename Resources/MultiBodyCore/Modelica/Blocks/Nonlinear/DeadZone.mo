within Modelica.Blocks.Nonlinear;
block DeadZone "No output for small inputs"
  parameter Real uMax(start=1) "Upper end of the dead zone";
  parameter Real uMin=-uMax "Lower end of the dead zone";
  extends Modelica.Blocks.Interfaces.SISO;
equation
  assert(uMax >= uMin, "DeadZone: uMax must not be smaller than uMin; exchange the limits");
  y = smooth(0, if u > uMax then u - uMax else if u < uMin then u - uMin else 0);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,-60},{-30,0},{30,0},{80,60}}, color={0,0,160}, thickness=0.5)}),
    Documentation(info="<html>
<p>The output is zero between <code>uMin</code> and <code>uMax</code>, and the distance to the nearer one outside.</p></html>"));
end DeadZone;
