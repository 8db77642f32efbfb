within CoreFixtures;
model UniversalSwing "Body on a universal joint"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(n={0,0,-1}, g=9.81, enableAnimation=false);
  MB.Joints.Universal joint(n_a={1,0,0}, n_b={0,1,0}, phi_a(fixed=true, start=0.4), w_a(fixed=true), phi_b(fixed=true, start=-0.3),
    w_b(fixed=true, start=0.5), animation=false);
  MB.Parts.BodyShape body(r={0,0,-1}, r_CM={0,0,-0.5}, m=1.5, I_11=0.1, I_22=0.2, I_33=0.05, animation=false);
  Real energy = 0.5*body.m*(body.v_0 + MB.Frames.resolve1(body.frame_a.R, cross(body.body.w_a, body.r_CM)))*(body.v_0 +
    MB.Frames.resolve1(body.frame_a.R, cross(body.body.w_a, body.r_CM))) + 0.5*body.body.w_a*(body.body.I*body.body.w_a) + body.m*world.g*(body.r_0[3] +
    MB.Frames.resolve1(body.frame_a.R, body.r_CM)*{0,0,1}) "Total energy";
equation
  connect(world.frame_b, joint.frame_a);
  connect(joint.frame_b, body.frame_a);
  annotation (experiment(StopTime=2, Tolerance=1e-9));
end UniversalSwing;
