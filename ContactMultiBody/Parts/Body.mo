within ContactMultiBody.Parts;
model Body "Rigid body with mass and inertia tensor that can collide"
  extends Modelica.Mechanics.MultiBody.Parts.Body;
  parameter String geometry="" "Descriptor of the geometry in frame_a, see Shapes; empty: does not collide"
    annotation (Dialog(group="Contact"));
  parameter Materials.Material material "Material of the surface" annotation (Dialog(group="Contact"), choicesAllMatching=true);
  parameter Boolean checkInertia=true "= true, if a tensor of inertia that no body has is told of: a principal moment larger than the sum of the others"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(tab="Advanced"));
  final parameter Inertia inertia(m=m, r_CM=r_CM, I=I) "Inertia, for contacts without events";
  final parameter Collider collider(geometry=geometry, material=material, inertia=inertia) "All of these, for the contact manager";
equation
  assert(Internal.isSemidefinite(I), "The tensor of inertia has a negative principal moment.");
  assert(not checkInertia or Internal.isSemidefinite(identity(3)*(I[1, 1] + I[2, 2] + I[3, 3])/2 - I), "No body has this tensor of inertia: a principal moment is larger than the sum of the other two. Right all the same if it turns about one axis alone; else correct it. checkInertia = false ends this warning.",
    AssertionLevel.warning);
  annotation (Documentation(info="<html>
<p>
Modelica.Mechanics.MultiBody.Parts.Body with a geometry and a material. Neither adds an equation; contacts are computed by the
<a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a> frame_a is connected to. Where no joint holds the body, take
<a href=\"modelica://ContactMultiBody.Parts.FreeBody\">FreeBody</a>: the motion is the same, but some tools cannot initialize FMUs that they export of a free Body.
</p>
</html>"));
end Body;
