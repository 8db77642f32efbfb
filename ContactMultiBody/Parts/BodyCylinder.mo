within ContactMultiBody.Parts;
model BodyCylinder "Rigid cylinder that can collide; mass and animation follow from size and density"
  extends Modelica.Mechanics.MultiBody.Parts.BodyCylinder;
  parameter String geometry=Shapes.cylinder(diameter/2, length, r_CM, {R.T[2, :],R.T[3, :],R.T[1, :]})
    "Descriptor of the geometry in frame_a, see Shapes" annotation (Dialog(group="Contact"));
  parameter Materials.Material material "Material of the surface" annotation (Dialog(group="Contact"), choicesAllMatching=true);
  final parameter Inertia inertia(m=m, r_CM=r_CM, I=I) "Inertia, for contacts without events";
  final parameter Collider collider(geometry=geometry, material=material, inertia=inertia) "All of these, for the contact manager";
  annotation (Documentation(info="<html>
<p>
Modelica.Mechanics.MultiBody.Parts.BodyCylinder whose geometry is by default the cylinder itself, bore filled. Neither geometry nor
material adds an equation; contacts are computed by the <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>
frame_a is connected to.
</p>
</html>"));
end BodyCylinder;
