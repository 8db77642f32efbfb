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
<code>collider={ball.collider,floor.collider}</code>, elements of arrays of bodies one by one: <code>{ball[1].collider,ball[2].collider,floor.collider}</code>.
The shorter <code>cat(1, ball.collider, {floor.collider})</code> is legal Modelica, but not translated by the built-in FMU builder.
</p>
<p>
A list in another order than the frames is noticed where a Ground or a Fixed is involved: its collider says where its frame is, and the manager asserts that.
</p>
</html>"));
end Collider;
