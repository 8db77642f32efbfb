within Modelica.Mechanics.Translational.Components;
model SpringDamper "Linear spring and linear damper side by side"
  extends Modelica.Mechanics.Translational.Interfaces.PartialCompliantWithRelativeStates;
  parameter SI.TranslationalSpringConstant c(final min=0, start=1) "Stiffness";
  parameter SI.TranslationalDampingConstant d(final min=0, start=1) "Damping";
  parameter SI.Position s_rel0=0 "s_rel of the relaxed spring";
  extends Modelica.Thermal.HeatTransfer.Interfaces.PartialElementaryConditionalHeatPortWithoutT;
protected
  SI.Force f_c "Force of the spring";
  SI.Force f_d "Force of the damper";
equation
  f_c = c*(s_rel - s_rel0);
  f_d = d*v_rel;
  f = f_c + f_d;
  lossPower = f_d*v_rel;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-90,0},{-60,0},{-60,50},{-45,50},{-30,75},{0,25},{30,75},{45,50},{60,50},{60,0},{90,0}}, color={0,110,0}, thickness=1),
        Line(points={{-60,0},{-60,-50},{0,-50}}, color={0,110,0}, thickness=1),
        Line(points={{-30,-25},{30,-25},{30,-75},{-30,-75}}, color={0,110,0}, thickness=1),
        Line(points={{30,-50},{60,-50},{60,0}}, color={0,110,0}, thickness=1),
        Text(extent={{-150,125},{150,90}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>A spring and a damper between the same flanges.</p></html>"));
end SpringDamper;
