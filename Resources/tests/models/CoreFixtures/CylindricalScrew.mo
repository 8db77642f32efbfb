within CoreFixtures;
model CylindricalScrew "Body that falls along an axis and turns about it"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(n={0,0,-1}, g=9.81, enableAnimation=false);
  MB.Joints.Cylindrical joint(n={0,0,1}, s(fixed=true), v(fixed=true, start=1), phi(fixed=true), w(fixed=true, start=2), animation=false);
  MB.Parts.Body body(m=2, r_CM={0,0,0.3}, I_11=0.1, I_22=0.2, I_33=0.3, animation=false);
equation
  connect(world.frame_b, joint.frame_a);
  connect(joint.frame_b, body.frame_a);
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end CylindricalScrew;
