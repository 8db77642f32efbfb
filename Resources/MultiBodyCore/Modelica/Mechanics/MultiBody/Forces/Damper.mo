within Modelica.Mechanics.MultiBody.Forces;
model Damper "Linear damper between two frames"
  import Modelica.Mechanics.MultiBody.Types;
  parameter Boolean animation=true "= true, if the damper is shown";
  parameter SI.TranslationalDampingConstant d(final min=0, start=0) "Damping";
  parameter SI.Distance length_a=world.defaultForceLength "Length of the cylinder at frame_a" annotation (Dialog(tab="Animation"));
  input SI.Diameter diameter_a=world.defaultForceWidth "Diameter of the cylinder at frame_a" annotation (Dialog(tab="Animation"));
  input SI.Diameter diameter_b=0.6*diameter_a "Diameter of the cylinder at frame_b" annotation (Dialog(tab="Animation"));
  input Types.Color color_a={100,100,100} "Colour of the cylinder at frame_a" annotation (Dialog(tab="Animation"));
  input Types.Color color_b={155,155,155} "Colour of the cylinder at frame_b" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialLineForce;
  extends Modelica.Thermal.HeatTransfer.Interfaces.PartialElementaryConditionalHeatPort(final T=293.15);
equation
  f = d*der(s);
  lossPower = f*der(s);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{-10,0}}, color={0,0,160}, thickness=1),
        Line(points={{-40,40},{30,40},{30,-40},{-40,-40}}, color={0,0,160}, thickness=1),
        Line(points={{-10,30},{-10,-30}}, color={0,0,160}, thickness=1),
        Line(points={{30,0},{100,0}}, color={0,0,160}, thickness=1),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>The force <code>d*der(s)</code> acts along the line between the origins of the frames.</p></html>"));
end Damper;
