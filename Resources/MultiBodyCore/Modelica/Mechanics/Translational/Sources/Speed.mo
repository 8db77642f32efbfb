within Modelica.Mechanics.Translational.Sources;
model Speed "Motion after a signal of the velocity"
  extends Modelica.Mechanics.Translational.Interfaces.PartialElementaryOneFlangeAndSupport2(
    s(start=0, fixed=true, stateSelect=StateSelect.prefer));
  parameter Boolean exact=false "= true, if the signal is followed exactly and differentiated, else filtered";
  parameter SI.Frequency f_crit=50 "Frequency above which the signal is filtered, if exact = false";
  SI.Velocity v(stateSelect=if exact then StateSelect.default else StateSelect.prefer) "Derivative of s";
  SI.Acceleration a "Derivative of v, 0 if exact = true";
  Modelica.Blocks.Interfaces.RealInput v_ref(unit="m/s") "Wanted velocity"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
protected
  parameter SI.AngularFrequency w_crit=2*Modelica.Constants.pi*f_crit "Critical frequency of the filter";
initial equation
  if not exact then
    v = v_ref;
  end if;
equation
  v = der(s);
  if exact then
    v = v_ref;
    a = 0;
  else
    a = der(v);
    a/w_crit + v = v_ref;
  end if;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-80,40},{60,-40}}, lineColor={70,70,70}, fillColor={220,220,220}, fillPattern=FillPattern.Solid),
        Line(points={{-60,0},{50,0}}, color={0,110,0}, thickness=1, arrow={Arrow.None,Arrow.Filled}),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>Moves the flange, whatever force it takes. With <code>exact = true</code> the signal must be differentiable.
Otherwise a filter of first order with the critical frequency <code>f_crit</code> smooths it; the motion starts at the value of
the signal.</p></html>"));
end Speed;
