within ContactMultiBody.Actuators.Translational;
model Position "Ideal drive that follows a filtered position, whatever force it takes"
  extends Interfaces.PartialTranslationalDrive;
  parameter Modelica.Units.SI.Frequency f_crit(min=Modelica.Constants.small)=10 "Critical frequency of the filter";
  parameter Real D(min=0, unit="1")=1 "Damping ratio of the filter; 1: no overshoot";
  Modelica.Blocks.Interfaces.RealInput s_ref(final quantity="Length", final unit="m") "Wanted position"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
protected
  final parameter Modelica.Units.SI.AngularFrequency w_crit=2*Modelica.Constants.pi*f_crit "Critical angular frequency";
equation
  der(v) = w_crit^2*(s_ref - s) - 2*D*w_crit*v;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-70,-60},{-40,-60},{-20,20},{40,20}}, color={0,0,127}, smooth=Smooth.Bezier, thickness=0.5),
        Line(points={{-70,-60},{-40,-60},{-40,20},{40,20}}, color={0,0,127}, pattern=LinePattern.Dot)}),
    Documentation(info="<html>
<p>
The flange moves as a filter of second order of the signal does,
</p>
<blockquote><p><code>der(der(s)) = w_crit^2*(s_ref - s) - 2*D*w_crit*der(s)</code>, <code>w_crit = 2*pi*f_crit</code>,</p></blockquote>
<p>
so the signal may jump. The position and the speed of the flange are the filter's states: the motion starts where the joint starts, and
its start values stay those of the joint. For a step and <code>D = 1</code> the response is <code>1 - (1 + w_crit*t)*exp(-w_crit*t)</code>.
</p>
</html>"));
end Position;
