within ContactMultiBody.Actuators.Translational;
model Friction "Viscous and dry friction in a joint"
  extends Interfaces.PartialTranslationalDrive;
  parameter Modelica.Units.SI.TranslationalDampingConstant d(min=0)=0 "Viscous friction: force over speed";
  parameter Modelica.Units.SI.Force f_dry(min=0)=0 "Dry friction: largest force";
  parameter Modelica.Units.SI.Velocity v_small(min=Modelica.Constants.small)=0.001 "Speed up to which dry friction grows";
equation
  f = -d*v - f_dry*tanh(v/v_small);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,-15},{60,-15}}, color={128,128,128}), Line(points={{-10,45},{-10,-75}}, color={128,128,128}),
        Line(points={{-80,-60},{-15,-50},{-5,20},{60,30}}, color={0,127,0}, thickness=0.5)}),
    Documentation(info="<html>
<p>
<code>f = -d*v - f_dry*tanh(v/v_small)</code>. Dry friction without states or events: at rest it lets the joint creep
with at most <code>v_small*atanh(x)</code> under a load that is the fraction x of <code>f_dry</code>.
</p>
</html>"));
end Friction;
