within CoreFixtures;
model RevolutePendulum "Physical pendulum with a large amplitude"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(n={0,0,-1}, g=9.81, enableAnimation=false);
  MB.Joints.Revolute joint(n={0,1,0}, phi(fixed=true, start=1.2), w(fixed=true), animation=false);
  MB.Parts.BodyShape rod(r={0,0,-1}, r_CM={0,0,-0.6}, m=2, I_11=0.1, I_22=0.3, I_33=0.2, animation=false);
equation
  connect(world.frame_b, joint.frame_a);
  connect(joint.frame_b, rod.frame_a);
  annotation (experiment(StopTime=3, Tolerance=1e-9));
end RevolutePendulum;
