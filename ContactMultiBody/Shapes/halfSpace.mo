within ContactMultiBody.Shapes;
pure function halfSpace "Solid half-space below a plane"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position position[3]={0,0,0} "A point of the plane in the frame of the body";
  input Real normal[3](each unit="1")={0,0,1} "Outward normal in the frame of the body";
  output String geometry "Descriptor";
protected
  Real e[3](each unit="1") "Unit normal";
  Real c[3](each unit="1") "Coordinate axis farthest from the normal";
  Real a[3](each unit="1") "First axis of the plane";
algorithm
  assert(normal*normal > 0, "Shapes.halfSpace: the normal is the zero vector; give the direction that points out of the solid.");
  e := normal/sqrt(normal*normal);
  c := if abs(e[1]) <= abs(e[2]) and abs(e[1]) <= abs(e[3]) then {1.0,0.0,0.0}
    elseif abs(e[2]) <= abs(e[3]) then {0.0,1.0,0.0} else {0.0,0.0,1.0};
  a := c - (c*e)*e;
  a := a/sqrt(a*a);
  geometry := "cmb/1 halfspace" + Internal.placement(position, {a, cross(e, a), e});
  annotation (Documentation(info="<html>
<p>
Everything on the side the normal points away from is solid: floors, walls, inclines. Nothing gets through a half-space,
however fast it is. Two half-spaces never touch each other.
</p>
</html>"));
end halfSpace;
