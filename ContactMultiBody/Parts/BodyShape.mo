within ContactMultiBody.Parts;
model BodyShape "Rigid body with two frames that can collide"
  extends Modelica.Mechanics.MultiBody.Parts.BodyShape;
  parameter String geometry="" "Descriptor of the geometry in frame_a, see Shapes; empty: does not collide"
    annotation (Dialog(group="Contact"));
  parameter Materials.Material material "Material of the surface" annotation (Dialog(group="Contact"), choicesAllMatching=true);
  parameter Boolean checkInertia=true "= true, if a tensor of inertia that no body has is told of: a principal moment larger than the sum of the others"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(tab="Advanced"));
  final parameter Inertia inertia(m=m, r_CM=r_CM, I={{I_11,I_21,I_31},{I_21,I_22,I_32},{I_31,I_32,I_33}}) "Inertia, for contacts without events";
  final parameter Collider collider(geometry=geometry, material=material, inertia=inertia) "All of these, for the contact manager";
equation
  assert(Internal.isSemidefinite(inertia.I), "The tensor of inertia has a negative principal moment.");
  assert(not checkInertia or Internal.isSemidefinite(identity(3)*(inertia.I[1, 1] + inertia.I[2, 2] + inertia.I[3, 3])/2 - inertia.I), "No body has this tensor of inertia: a principal moment is larger than the sum of the other two. Right all the same if it turns about one axis alone; else correct it. checkInertia = false ends this warning.",
    AssertionLevel.warning);
  annotation (Documentation(info="<html>
<p>
Modelica.Mechanics.MultiBody.Parts.BodyShape with a geometry and a material. Neither adds an equation; contacts are computed by the
<a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a> frame_a is connected to.
</p>
</html>"));
end BodyShape;
