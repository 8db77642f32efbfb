within Modelica.Mechanics.Rotational.Components;
model SpringDamper "Linear spring and linear damper side by side"
  parameter SI.RotationalSpringConstant c(final min=0, start=1.0e5) "Stiffness";
  parameter SI.RotationalDampingConstant d(final min=0, start=0) "Damping";
  parameter SI.Angle phi_rel0=0 "phi_rel of the relaxed spring";
  extends Modelica.Mechanics.Rotational.Interfaces.PartialCompliantWithRelativeStates;
  extends Modelica.Thermal.HeatTransfer.Interfaces.PartialElementaryConditionalHeatPortWithoutT;
protected
  SI.Torque tau_c "Torque of the spring";
  SI.Torque tau_d "Torque of the damper";
equation
  tau_c = c*(phi_rel - phi_rel0);
  tau_d = d*w_rel;
  tau = tau_c + tau_d;
  lossPower = tau_d*w_rel;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-90,0},{-60,0},{-60,50},{-45,50},{-30,75},{0,25},{30,75},{45,50},{60,50},{60,0},{90,0}}, color={0,110,0}, thickness=1),
        Line(points={{-60,0},{-60,-50},{0,-50}}, color={0,110,0}, thickness=1),
        Line(points={{-30,-25},{30,-25},{30,-75},{-30,-75}}, color={0,110,0}, thickness=1),
        Line(points={{30,-50},{60,-50},{60,0}}, color={0,110,0}, thickness=1),
        Text(extent={{-150,125},{150,90}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>A spring and a damper between the same flanges.</p></html>"));
end SpringDamper;
