within ContactMultiBody.Actuators.Rotational;
model SpringDamper "Spring and damper between flange and housing"
  extends Interfaces.PartialRotationalDrive;
  parameter Modelica.Units.SI.RotationalSpringConstant c(min=0)=0 "Stiffness";
  parameter Modelica.Units.SI.RotationalDampingConstant d(min=0)=0 "Damping";
  parameter Modelica.Units.SI.Angle phi_rest=0 "Angle at which the spring is relaxed";
equation
  tau = c*(phi_rest - phi) - d*w;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,20},{-60,20},{-50,45},{-30,-5},{-10,45},{10,-5},{20,20},{50,20}}, color={0,0,0}),
        Line(points={{-80,-50},{-30,-50}}, color={0,0,0}), Line(points={{0,-30},{-30,-30},{-30,-70},{0,-70}}, color={0,0,0}),
        Line(points={{-20,-50},{50,-50}}, color={0,0,0})}),
    Documentation(info="<html>
<p>
Passive: <code>tau = c*(phi_rest - phi) - d*w</code>.
</p>
</html>"));
end SpringDamper;
