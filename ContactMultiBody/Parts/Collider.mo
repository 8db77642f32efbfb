within ContactMultiBody.Parts;
record Collider "What a contact manager has to know about a body: geometry, material and inertia"
  extends Modelica.Icons.Record;
  parameter String geometry="" "Descriptor of the geometry in the frame that is connected to the manager; empty: does not collide";
  parameter Materials.Material material "Material of the surface";
  parameter Inertia inertia "Inertia, for contacts without events";
  parameter Boolean isFixed=false "= true, if the frame stays at r_0" annotation (choices(checkBox=true));
  parameter Modelica.Units.SI.Position r_0[3]={0,0,0} "Where a fixed frame is, in world axes";
  annotation (Documentation(info="<html>
<p>
The bodies of <a href=\"modelica://ContactMultiBody.Parts\">Parts</a> have one, so that a manager takes one list in the order of its frames:
<code>collider={ball.collider,floor.collider}</code>; with an array of bodies, <code>collider=cat(1, ball.collider, {floor.collider})</code>.
</p>
<p>
<strong>A list in another order than the frames</strong> is noticed where a Ground or a Fixed is involved: its collider says where its frame is, and the manager asserts that. Where two movable bodies are swapped, no assertion
can: what a frame carries, position, orientation, force and torque, tells nothing of the body behind it, start values are no parameters, and parameters do not pass through connections. The built-in FMU builder sees the
connections and refuses such a model. In other tools look at the order once: <code>connect</code> in the order of the list, with the loop that the list has,
<code>for i in 1:n loop connect(ball[i].frame_a, contacts.frame[i]); end for;</code>.
</p>
</html>"));
end Collider;
