within Modelica.Mechanics.Translational.Sources;
model Position "Motion after a signal of the position"
  extends Modelica.Mechanics.Translational.Interfaces.PartialElementaryOneFlangeAndSupport2(
    s(stateSelect=if exact then StateSelect.default else StateSelect.prefer));
  parameter Boolean exact=false "= true, if the signal is followed exactly and differentiated, else filtered";
  parameter SI.Frequency f_crit=50 "Frequency above which the signal is filtered, if exact = false";
  SI.Velocity v(start=0, stateSelect=if exact then StateSelect.default else StateSelect.prefer) "Derivative of s";
  SI.Acceleration a(start=0) "Derivative of v";
  Modelica.Blocks.Interfaces.RealInput s_ref(unit="m") "Wanted position"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
protected
  parameter SI.AngularFrequency w_crit=2*Modelica.Constants.pi*f_crit "Critical frequency of the filter";
  constant Real af=1.3617 "Coefficient of s of the Bessel filter of second order";
  constant Real bf=0.6180 "Coefficient of s^2 of the Bessel filter of second order";
initial equation
  if not exact then
    s = s_ref;
  end if;
equation
  v = der(s);
  a = der(v);
  if exact then
    s = s_ref;
  else
    (bf/w_crit^2)*a + (af/w_crit)*v + s = s_ref;
  end if;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-80,40},{60,-40}}, lineColor={70,70,70}, fillColor={220,220,220}, fillPattern=FillPattern.Solid),
        Line(points={{-60,0},{50,0}}, color={0,110,0}, thickness=1, arrow={Arrow.None,Arrow.Filled}),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>Moves the flange, whatever force it takes. With <code>exact = true</code> the signal must be differentiable twice.
Otherwise a Bessel filter of second order with the critical frequency <code>f_crit</code> smooths it; the motion starts at the
value of the signal.</p></html>"));
end Position;
