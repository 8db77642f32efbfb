within CoreFixtures;
model MutualForces "Forces and torques between two free bodies, resolved in every way"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(gravityType=MB.Types.GravityTypes.NoGravity, enableAnimation=false);
  MB.Parts.Body first(m=2, r_CM={0.1,0,0}, I_11=0.1, I_22=0.2, I_33=0.3, r_0(each fixed=true), v_0(each fixed=true), angles_fixed=true, w_0_fixed=true,
    w_0_start={0,0,1}, animation=false);
  MB.Parts.Body second(m=1, r_CM={0,0.1,0}, I_11=0.1, I_22=0.2, I_33=0.3, r_0(start={1,0.5,0}, each fixed=true), v_0(each fixed=true), angles_fixed=true,
    angles_start={0.3,0.2,0.1}, w_0_fixed=true, animation=false);
  MB.Forces.Force force(animation=false);
  MB.Forces.Force forceInOther(resolveInFrame=MB.Types.ResolveInFrameAB.frame_resolve, animation=false);
  MB.Forces.Torque torque(resolveInFrame=MB.Types.ResolveInFrameAB.frame_a, animation=false);
  MB.Forces.ForceAndTorque both(resolveInFrame=MB.Types.ResolveInFrameAB.world, animation=false);
  MB.Forces.ForceAndTorque bothInBody(animation=false);
  SI.Momentum momentum[3] = first.m*(first.v_0 + MB.Frames.resolve1(first.frame_a.R, cross(first.w_a, first.r_CM))) + second.m*(second.v_0 +
    MB.Frames.resolve1(second.frame_a.R, cross(second.w_a, second.r_CM))) "Total momentum";
  SI.AngularMomentum spin[3] = MB.Frames.resolve1(first.frame_a.R, first.I*first.w_a) + first.m*cross(first.r_0 + MB.Frames.resolve1(first.frame_a.R,
    first.r_CM), first.v_0 + MB.Frames.resolve1(first.frame_a.R, cross(first.w_a, first.r_CM))) + MB.Frames.resolve1(second.frame_a.R, second.I*
    second.w_a) + second.m*cross(second.r_0 + MB.Frames.resolve1(second.frame_a.R, second.r_CM), second.v_0 + MB.Frames.resolve1(second.frame_a.R,
    cross(second.w_a, second.r_CM))) "Total angular momentum about the origin";
equation
  connect(first.frame_a, force.frame_a);
  connect(force.frame_b, second.frame_a);
  connect(first.frame_a, forceInOther.frame_a);
  connect(forceInOther.frame_b, second.frame_a);
  connect(world.frame_b, forceInOther.frame_resolve);
  connect(first.frame_a, torque.frame_a);
  connect(torque.frame_b, second.frame_a);
  connect(first.frame_a, both.frame_a);
  connect(both.frame_b, second.frame_a);
  connect(first.frame_a, bothInBody.frame_a);
  connect(bothInBody.frame_b, second.frame_a);
  force.force = {1,2,3};
  forceInOther.force = {0.1,-0.2,0.3};
  torque.torque = {0.1,0.2,0.3};
  both.force = {-1,0,1};
  both.torque = {0.2,0,0};
  bothInBody.force = {0,0.5,0};
  bothInBody.torque = {0,0,0.1};
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end MutualForces;
