within Modelica.Mechanics.Translational.Components;
model Damper "Linear damper"
  extends Modelica.Mechanics.Translational.Interfaces.PartialCompliantWithRelativeStates;
  parameter SI.TranslationalDampingConstant d(final min=0, start=0) "Damping";
  extends Modelica.Thermal.HeatTransfer.Interfaces.PartialElementaryConditionalHeatPortWithoutT;
equation
  f = d*v_rel;
  lossPower = f*v_rel;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-90,0},{-10,0}}, color={0,110,0}, thickness=1),
        Line(points={{-40,40},{30,40},{30,-40},{-40,-40}}, color={0,110,0}, thickness=1),
        Line(points={{-10,30},{-10,-30}}, color={0,110,0}, thickness=1),
        Line(points={{30,0},{90,0}}, color={0,110,0}, thickness=1),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>The force is proportional to <code>v_rel</code>.</p></html>"));
end Damper;
