within Modelica.Mechanics.MultiBody.Forces;
model SpringDamperParallel "Linear spring and linear damper side by side between two frames"
  import Modelica.Mechanics.MultiBody.Types;
  parameter Boolean animation=true "= true, if spring and damper are shown";
  parameter SI.TranslationalSpringConstant c(final min=0) "Stiffness";
  parameter SI.Length s_unstretched=0 "Length of the relaxed spring";
  parameter SI.TranslationalDampingConstant d(final min=0) = 0 "Damping";
  parameter SI.Distance length_a=world.defaultForceLength "Length of the cylinder at frame_a" annotation (Dialog(tab="Animation"));
  input SI.Diameter diameter_a=world.defaultForceWidth "Diameter of the cylinder at frame_a" annotation (Dialog(tab="Animation"));
  input SI.Diameter diameter_b=0.6*diameter_a "Diameter of the cylinder at frame_b" annotation (Dialog(tab="Animation"));
  input Types.Color color_a={100,100,100} "Colour of the cylinder at frame_a" annotation (Dialog(tab="Animation"));
  input Types.Color color_b={155,155,155} "Colour of the cylinder at frame_b" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  input SI.Distance width=world.defaultForceWidth "Width of the spring" annotation (Dialog(tab="Animation"));
  input SI.Distance coilWidth=width/10 "Width of the wire" annotation (Dialog(tab="Animation"));
  parameter Integer numberOfWindings=5 "Number of windings" annotation (Dialog(tab="Animation"));
  input Types.Color color=Modelica.Mechanics.MultiBody.Types.Defaults.SpringColor "Colour of the spring" annotation (Dialog(tab="Animation"));
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialLineForce;
  extends Modelica.Thermal.HeatTransfer.Interfaces.PartialElementaryConditionalHeatPort(final T=293.15);
protected
  SI.Force f_d "Force of the damper";
equation
  f_d = d*der(s);
  f = c*(s - s_unstretched) + f_d;
  lossPower = f_d*der(s);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{-60,0},{-45,30},{-15,-30},{15,30},{45,-30},{60,0},{100,0}}, color={0,0,160}, thickness=1),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>The force <code>c*(s - s_unstretched) + d*der(s)</code> acts along the line between the origins of the frames.</p></html>"));
end SpringDamperParallel;
