within ContactMultiBody.Parts;
model Body "Rigid body with mass and inertia tensor that can collide"
  extends Modelica.Mechanics.MultiBody.Parts.Body;
  parameter String geometry="" "Descriptor of the geometry in frame_a, see Shapes; empty: does not collide"
    annotation (Dialog(group="Contact"));
  parameter Materials.Material material "Material of the surface" annotation (Dialog(group="Contact"), choicesAllMatching=true);
  final parameter Inertia inertia(m=m, r_CM=r_CM, I=I) "Inertia, for contacts without events";
  final parameter Collider collider(geometry=geometry, material=material, inertia=inertia) "All of these, for the contact manager";
  annotation (Documentation(info="<html>
<p>
Modelica.Mechanics.MultiBody.Parts.Body with a geometry and a material. Neither adds an equation; contacts are computed by the
<a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a> frame_a is connected to.
</p>
</html>"));
end Body;
