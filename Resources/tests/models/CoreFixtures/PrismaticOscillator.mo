within CoreFixtures;
model PrismaticOscillator "Mass on a prismatic joint with spring and damper"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(n={0,0,-1}, g=9.81, enableAnimation=false);
  MB.Joints.Prismatic joint(n={0,0,1}, useAxisFlange=true, s(fixed=true, start=0.1), v(fixed=true, start=0.2), animation=false);
  MB.Parts.Body body(m=2, r_CM={0.1,0.2,0.3}, animation=false);
  Modelica.Mechanics.Translational.Components.SpringDamper spring(c=50, d=3, s_rel0=0.05, s_rel(start=0.1), v_rel(start=0.2));
equation
  connect(world.frame_b, joint.frame_a);
  connect(joint.frame_b, body.frame_a);
  connect(joint.support, spring.flange_a);
  connect(joint.axis, spring.flange_b);
  annotation (experiment(StopTime=2, Tolerance=1e-9));
end PrismaticOscillator;
