within ContactMultiBody.Joints;
model RackCoupling "A distance and an angle in a fixed ratio, as by an ideal rack and pinion"
  Modelica.Mechanics.Rotational.Interfaces.Flange_a flangeR "Flange that turns"
    annotation (Placement(transformation(extent={{-110,-10},{-90,10}})));
  Modelica.Mechanics.Translational.Interfaces.Flange_b flangeT "Flange that slides"
    annotation (Placement(transformation(extent={{90,-10},{110,10}})));
  parameter Real ratio(final unit="m/rad")=1 "Way of flangeT over angle of flangeR; negative: in the opposite sense";
  parameter Modelica.Units.SI.Position offset=0 "Position of flangeT where the angle of flangeR is zero";
equation
  flangeT.s = ratio*flangeR.phi + offset;
  0 = flangeR.tau + ratio*flangeT.f;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-60,60},{20,-20}}, lineColor={64,64,64}, fillColor={215,215,215}, fillPattern=FillPattern.Solid),
        Rectangle(extent={{-70,-20},{70,-40}}, lineColor={64,64,64}, fillColor={192,192,192}, fillPattern=FillPattern.Solid),
        Line(points={{-100,0},{-80,0},{-80,20},{-20,20}}, color={0,0,0}),
        Line(points={{70,-30},{85,-30},{85,0},{100,0}}, color={0,127,0}),
        Text(extent={{-150,110},{150,70}}, textColor={0,0,255}, textString="%name"),
        Text(extent={{-150,-60},{150,-90}}, textColor={0,0,0}, textString="%ratio")}),
    Documentation(info="<html>
<p>
<code>flangeT.s = ratio*flangeR.phi + offset</code>; torque and force balance so that no power is lost:
<code>flangeR.tau = -ratio*flangeT.f</code>. Either may lead. Used as
<a href=\"modelica://ContactMultiBody.Joints.RotationalCoupling\">RotationalCoupling</a> is.
</p>
</html>"));
end RackCoupling;
