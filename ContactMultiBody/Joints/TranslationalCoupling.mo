within ContactMultiBody.Joints;
model TranslationalCoupling "One distance follows another in a fixed ratio, as by an ideal lever or rope"
  Modelica.Mechanics.Translational.Interfaces.Flange_a flange_a "Flange that leads"
    annotation (Placement(transformation(extent={{-110,-10},{-90,10}})));
  Modelica.Mechanics.Translational.Interfaces.Flange_b flange_b "Flange that follows"
    annotation (Placement(transformation(extent={{90,-10},{110,10}})));
  parameter Real ratio(unit="1")=1 "Way of flange_b over way of flange_a; negative: in the opposite sense";
  parameter Modelica.Units.SI.Position offset=0 "Position of flange_b where that of flange_a is zero";
equation
  flange_b.s = ratio*flange_a.s + offset;
  0 = flange_a.f + ratio*flange_b.f;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{-60,0},{-60,40},{60,-40},{60,0},{100,0}}, color={0,127,0}, thickness=0.5),
        Polygon(points={{0,0},{-15,-40},{15,-40},{0,0}}, lineColor={64,64,64}, fillColor={192,192,192}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,100},{150,60}}, textColor={0,0,255}, textString="%name"),
        Text(extent={{-150,-60},{150,-90}}, textColor={0,0,0}, textString="%ratio")}),
    Documentation(info="<html>
<p>
<code>flange_b.s = ratio*flange_a.s + offset</code>; the forces balance so that no power is lost:
<code>flange_a.f = -ratio*flange_b.f</code>. Used as
<a href=\"modelica://ContactMultiBody.Joints.RotationalCoupling\">RotationalCoupling</a> is.
</p>
</html>"));
end TranslationalCoupling;
