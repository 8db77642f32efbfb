within CoreFixtures;
model Homogeneous "Box and cylinder with holes, mass and inertia from their size"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(n={0,0,-1}, g=9.81, enableAnimation=false);
  MB.Parts.Fixed pivot(r={0,0,1}, animation=false);
  MB.Joints.Revolute joint(n={0,1,0}, phi(fixed=true), w(fixed=true), animation=false);
  MB.Parts.BodyBox box(r={0.4,0,0.1}, width=0.1, height=0.2, innerWidth=0.04, innerHeight=0.05, density=1000, animation=false);
  MB.Joints.Revolute elbow(n={0,1,0}, phi(fixed=true), w(fixed=true), animation=false);
  MB.Parts.BodyCylinder tube(r={0.5,0.1,0}, diameter=0.1, innerDiameter=0.06, density=2000, animation=false);
equation
  connect(pivot.frame_b, joint.frame_a);
  connect(joint.frame_b, box.frame_a);
  connect(box.frame_b, elbow.frame_a);
  connect(elbow.frame_b, tube.frame_a);
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end Homogeneous;
