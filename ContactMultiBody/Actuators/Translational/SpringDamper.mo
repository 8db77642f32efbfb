within ContactMultiBody.Actuators.Translational;
model SpringDamper "Spring and damper between flange and housing"
  extends Interfaces.PartialTranslationalDrive;
  parameter Modelica.Units.SI.TranslationalSpringConstant c(min=0)=0 "Stiffness";
  parameter Modelica.Units.SI.TranslationalDampingConstant d(min=0)=0 "Damping";
  parameter Modelica.Units.SI.Position s_rest=0 "Position at which the spring is relaxed";
equation
  f = c*(s_rest - s) - d*v;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,20},{-60,20},{-50,45},{-30,-5},{-10,45},{10,-5},{20,20},{50,20}}, color={0,127,0}),
        Line(points={{-80,-50},{-30,-50}}, color={0,127,0}), Line(points={{0,-30},{-30,-30},{-30,-70},{0,-70}}, color={0,127,0}),
        Line(points={{-20,-50},{50,-50}}, color={0,127,0})}),
    Documentation(info="<html>
<p>
Passive: <code>f = c*(s_rest - s) - d*v</code>.
</p>
</html>"));
end SpringDamper;
