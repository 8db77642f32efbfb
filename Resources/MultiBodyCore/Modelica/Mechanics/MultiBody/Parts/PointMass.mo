within Modelica.Mechanics.MultiBody.Parts;
model PointMass "Mass without inertia; the orientation of its frame is free of it"
  import Modelica.Mechanics.MultiBody.Types;
  Interfaces.Frame_a frame_a "Frame, fixed to the mass"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
  parameter Boolean animation=true "= true, if a sphere is shown";
  parameter SI.Mass m(min=0) "Mass";
  input SI.Diameter sphereDiameter=world.defaultBodyDiameter "Diameter of the sphere" annotation (Dialog(tab="Animation"));
  input Types.Color sphereColor=Modelica.Mechanics.MultiBody.Types.Defaults.BodyColor "Colour of the sphere" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  parameter StateSelect stateSelect=StateSelect.avoid "Priority of r_0 and v_0 as states" annotation (Dialog(tab="Advanced"));
  SI.Position r_0[3](start={0,0,0}, each stateSelect=stateSelect) "Position, from the origin of the world frame, in its coordinates";
  SI.Velocity v_0[3](start={0,0,0}, each stateSelect=stateSelect) "Velocity, in coordinates of the world frame";
  SI.Acceleration a_0[3](start={0,0,0}) "Acceleration, in coordinates of the world frame";
protected
  outer Modelica.Mechanics.MultiBody.World world;
equation
  // Nothing turns a point: where nothing else says an orientation, frame_a is parallel to the world frame.
  Connections.potentialRoot(frame_a.R, 10000);
  if Connections.isRoot(frame_a.R) then
    frame_a.R = Frames.nullRotation();
    assert(frame_a.t*frame_a.t < 1e-20, "PointMass: a torque acts on the frame of a mass point that nothing else holds; use a Body");
  else
    frame_a.t = zeros(3);
  end if;
  r_0 = frame_a.r_0;
  v_0 = der(r_0);
  a_0 = der(v_0);
  frame_a.f = m*Frames.resolve2(frame_a.R, a_0 - world.gravityAcceleration(r_0));
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-50,50},{50,-50}}, lineColor={0,60,140}, fillColor={0,110,220}, fillPattern=FillPattern.Sphere),
        Text(extent={{-150,100},{150,65}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>A mass at the origin of frame_a, without moments of inertia: no torque is needed to turn its frame.</p></html>"));
end PointMass;
