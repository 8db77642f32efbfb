within Modelica.Mechanics.MultiBody.Forces;
model LineForceWithMass "Force of a translational element along the line between two frames, with a point mass on it"
  import Modelica.Mechanics.MultiBody.Types;
  extends Modelica.Mechanics.MultiBody.Interfaces.LineForceBase;
  Modelica.Mechanics.Translational.Interfaces.Flange_a flange_b "Its position is the distance of the frames"
    annotation (Placement(transformation(extent={{50,90},{70,110}})));
  Modelica.Mechanics.Translational.Interfaces.Flange_b flange_a "Its position is zero"
    annotation (Placement(transformation(extent={{-70,90},{-50,110}})));
  parameter Boolean animateLine=true "= true, if the line is shown";
  parameter Boolean animateMass=true "= true, if the mass is shown";
  parameter SI.Mass m(min=0) = 0 "Mass on the line between the frames";
  parameter Real lengthFraction(unit="1", min=0, max=1) = 0.5 "Where the mass is: 0 at frame_a, 1 at frame_b";
  parameter Types.ShapeType lineShapeType="cylinder" "Kind of the line's shape" annotation (Dialog(tab="Animation"));
  input SI.Length lineShapeWidth=world.defaultArrowDiameter "Width of the line" annotation (Dialog(tab="Animation"));
  input SI.Length lineShapeHeight=lineShapeWidth "Height of the line" annotation (Dialog(tab="Animation"));
  parameter Types.ShapeExtra lineShapeExtra=0.0 "One more number that some shapes need" annotation (Dialog(tab="Animation"));
  input Types.Color lineShapeColor=Modelica.Mechanics.MultiBody.Types.Defaults.SensorColor "Colour of the line" annotation (Dialog(tab="Animation"));
  input Real massDiameter=world.defaultBodyDiameter "Diameter of the mass" annotation (Dialog(tab="Animation"));
  input Types.Color massColor=Modelica.Mechanics.MultiBody.Types.Defaults.BodyColor "Colour of the mass" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
protected
  SI.Force fa "Force of the element on flange_a, towards frame_b";
  SI.Force fb "Force of the element on flange_b, away from frame_a";
  SI.Position r_CM_0[3](each stateSelect=StateSelect.avoid) "Position of the mass, in coordinates of the world frame";
  SI.Velocity v_CM_0[3](each stateSelect=StateSelect.avoid) "Derivative of r_CM_0";
  SI.Force f_CM_0[3] "Inertial force and weight of the mass, in coordinates of the world frame";
equation
  flange_a.s = 0;
  flange_b.s = length;
  fa = flange_a.f;
  fb = flange_b.f;
  r_CM_0 = frame_a.r_0 + lengthFraction*r_rel_0;
  if m > 0 then
    v_CM_0 = der(r_CM_0);
    f_CM_0 = m*(der(v_CM_0) - world.gravityAcceleration(r_CM_0));
  else
    v_CM_0 = zeros(3);
    f_CM_0 = zeros(3);
  end if;

  // The mass is held by the two ends like a load on a beam; what acts across the line is shared by the lever rule,
  // and so is what acts along it.
  frame_a.f = Frames.resolve2(frame_a.R, (1 - lengthFraction)*f_CM_0 - fa*e_rel_0);
  frame_b.f = Frames.resolve2(frame_b.R, lengthFraction*f_CM_0 - fb*e_rel_0);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{100,0}}, color={70,70,70}, pattern=LinePattern.Dash),
        Ellipse(extent={{-25,25},{25,-25}}, lineColor={70,70,70}, fillColor={190,190,190}, fillPattern=FillPattern.Sphere),
        Text(extent={{-150,-40},{150,-75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>A translational spring, damper or drive between <code>flange_a</code> and <code>flange_b</code> acts along the line between
the origins of frame_a and frame_b.</p></html>"));
end LineForceWithMass;
