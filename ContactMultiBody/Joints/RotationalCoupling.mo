within ContactMultiBody.Joints;
model RotationalCoupling "One angle follows another in a fixed ratio, as by an ideal gear or belt"
  extends Modelica.Mechanics.Rotational.Interfaces.PartialTwoFlanges;
  parameter Real ratio(unit="1")=1 "Way of flange_b over way of flange_a; negative: in the opposite sense";
  parameter Modelica.Units.SI.Angle offset=0 "Angle of flange_b where that of flange_a is zero";
equation
  flange_b.phi = ratio*flange_a.phi + offset;
  0 = flange_a.tau + ratio*flange_b.tau;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-80,40},{0,-40}}, lineColor={64,64,64}, fillColor={215,215,215}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{0,40},{80,-40}}, lineColor={64,64,64}, fillColor={192,192,192}, fillPattern=FillPattern.Solid),
        Line(points={{-100,0},{-40,0}}, color={0,0,0}),
        Line(points={{40,0},{100,0}}, color={0,0,0}),
        Text(extent={{-150,100},{150,60}}, textColor={0,0,255}, textString="%name"),
        Text(extent={{-150,-60},{150,-90}}, textColor={0,0,0}, textString="%ratio")}),
    Documentation(info="<html>
<p>
<code>flange_b.phi = ratio*flange_a.phi + offset</code>; the torques balance so that no power is lost:
<code>flange_a.tau = -ratio*flange_b.tau</code>. Connected to the flanges <code>axis</code> of two joints it makes the second
follow the first (the element <code>mimic</code> of robot descriptions), and the first carry what the second needs. One of the two
joints has states; let the second have <code>stateSelect=StateSelect.avoid</code> and no fixed start values.
</p>
</html>"));
end RotationalCoupling;
