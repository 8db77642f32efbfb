within ContactMultiBody.Joints;
model LoopClosure "Closes a kinematic loop by chosen conditions, where its other joints hold the rest by their geometry"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;
  parameter Boolean x_locked=true "= true, if the distance along x of frame_a is held at zero" annotation (Evaluate=true, choices(checkBox=true));
  parameter Boolean y_locked=true "= true, if the distance along y of frame_a is held at zero" annotation (Evaluate=true, choices(checkBox=true));
  parameter Boolean z_locked=true "= true, if the distance along z of frame_a is held at zero" annotation (Evaluate=true, choices(checkBox=true));
  parameter Boolean turn_x_locked=true "= true, if the turn about x of frame_a is held at zero" annotation (Evaluate=true, choices(checkBox=true));
  parameter Boolean turn_y_locked=true "= true, if the turn about y of frame_a is held at zero" annotation (Evaluate=true, choices(checkBox=true));
  parameter Boolean turn_z_locked=true "= true, if the turn about z of frame_a is held at zero" annotation (Evaluate=true, choices(checkBox=true));
  parameter Modelica.Units.SI.Length distance_max=1e-6 "Largest distance that the conditions left out may show";
  parameter Modelica.Units.SI.Angle angle_max=1e-6 "Largest turn that the conditions left out may show";
  Modelica.Units.SI.Position r_rel_a[3] "Position of frame_b from the origin of frame_a, in coordinates of frame_a: zero";
  Modelica.Units.SI.Angle turn[3] "Small turn of frame_b against frame_a, in coordinates of frame_a: zero";
  Modelica.Units.SI.Force f_a[3] "Force on frame_b, in coordinates of frame_a; zero where nothing is held";
  Modelica.Units.SI.Torque t_a[3] "Torque on frame_b, in coordinates of frame_a; zero where nothing is held";
protected
  Modelica.Mechanics.MultiBody.Frames.Orientation R_rel "Orientation of frame_b with respect to frame_a";
equation
  R_rel = Modelica.Mechanics.MultiBody.Frames.relativeRotation(frame_a.R, frame_b.R);
  r_rel_a = Modelica.Mechanics.MultiBody.Frames.resolve2(frame_a.R, frame_b.r_0 - frame_a.r_0);
  // The antisymmetric part of a rotation is the sine of its angle along its axis.
  turn = {R_rel.T[2, 3] - R_rel.T[3, 2], R_rel.T[3, 1] - R_rel.T[1, 3], R_rel.T[1, 2] - R_rel.T[2, 1]}/2;
  if x_locked then
    r_rel_a[1] = 0;
  else
    f_a[1] = 0;
  end if;
  if y_locked then
    r_rel_a[2] = 0;
  else
    f_a[2] = 0;
  end if;
  if z_locked then
    r_rel_a[3] = 0;
  else
    f_a[3] = 0;
  end if;
  if turn_x_locked then
    turn[1] = 0;
  else
    t_a[1] = 0;
  end if;
  if turn_y_locked then
    turn[2] = 0;
  else
    t_a[2] = 0;
  end if;
  if turn_z_locked then
    turn[3] = 0;
  else
    t_a[3] = 0;
  end if;
  frame_b.f = -Modelica.Mechanics.MultiBody.Frames.resolve2(R_rel, f_a);
  frame_b.t = -Modelica.Mechanics.MultiBody.Frames.resolve2(R_rel, t_a);
  frame_a.f = f_a;
  frame_a.t = t_a + cross(r_rel_a, f_a);
  assert(max(abs(r_rel_a)) <= distance_max and max(abs(turn)) <= angle_max,
    "LoopClosure: the loop has opened. The conditions left out do not follow from those that are held in this position: the mechanism has passed a singular position, or its joints are not where its geometry needs them.");
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,25},{-10,-25}}, lineColor={64,64,64}, fillColor={192,192,192}, fillPattern=FillPattern.HorizontalCylinder),
        Rectangle(extent={{10,25},{100,-25}}, lineColor={64,64,64}, fillColor={192,192,192}, fillPattern=FillPattern.HorizontalCylinder),
        Line(points={{-10,60},{-10,-60}}, color={180,30,30}, thickness=0.5),
        Line(points={{10,60},{10,-60}}, color={180,30,30}, thickness=0.5),
        Text(extent={{-150,120},{150,80}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>
A rigid connection of frame_a and frame_b that closes a loop with only as many of its six conditions as are independent. Linkages of
Bennett, Sarrus and Bricard, a third crank of a parallelogram, or a nut on a spindle that slides in a guide move although they have more
closing conditions than freedoms, because of their special geometry: some conditions follow from the others. A model with all of them has
no solution for the forces. Choose conditions that are independent wherever the mechanism goes; no more and no fewer than the rank
of the loop's equations. Those left out are checked against <code>distance_max</code> and <code>angle_max</code>.
</p>
<p>
The motion does not depend on the choice. The forces in the loop do: rigid bodies do not determine them, and this model shows the ones
for which the conditions left out carry nothing.
</p>
<p>
All joints of the loop keep their coordinates; put this model between the last of them and the body it meets.
</p>
</html>"));
end LoopClosure;
