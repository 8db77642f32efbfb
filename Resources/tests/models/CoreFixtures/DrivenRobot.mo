within CoreFixtures;
model DrivenRobot "Arm with a position drive, a gear and a linear drive"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(n={0,0,-1}, g=9.81, enableAnimation=false);
  MB.Joints.Revolute shoulder(n={0,1,0}, useAxisFlange=true, animation=false);
  MB.Parts.BodyShape arm(r={0.5,0,0}, r_CM={0.25,0,0}, m=1, animation=false);
  MB.Joints.Prismatic slide(n={1,0,0}, useAxisFlange=true, s(fixed=true, start=0.1), v(fixed=true), animation=false);
  MB.Parts.Body load(m=0.5, r_CM={0,0,0}, animation=false);
  Modelica.Mechanics.Rotational.Sources.Position drive(exact=true, useSupport=true);
  Modelica.Mechanics.Translational.Components.SpringDamper spring(c=200, d=5, s_rel0=0.1);
equation
  drive.phi_ref = 0.5*(1 - cos(2*time));
  connect(world.frame_b, shoulder.frame_a);
  connect(shoulder.frame_b, arm.frame_a);
  connect(arm.frame_b, slide.frame_a);
  connect(slide.frame_b, load.frame_a);
  connect(drive.flange, shoulder.axis);
  connect(drive.support, shoulder.support);
  connect(spring.flange_a, slide.support);
  connect(spring.flange_b, slide.axis);
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end DrivenRobot;
