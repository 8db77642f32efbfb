within CoreFixtures;
model WorldForces "Forces and torques from the world, resolved in every way"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(gravityType=MB.Types.GravityTypes.NoGravity, enableAnimation=false);
  MB.Parts.Body body(m=2, r_CM={0.1,0,0}, I_11=0.1, I_22=0.2, I_33=0.3, r_0(each fixed=true), v_0(each fixed=true), angles_fixed=true, w_0_fixed=true,
    w_0_start={0,0,1}, animation=false);
  MB.Parts.FixedRotation resolve(n={0,0,1}, angle=30, animation=false);
  MB.Forces.WorldForce inWorld(animation=false);
  MB.Forces.WorldForce inBody(resolveInFrame=MB.Types.ResolveInFrameB.frame_b, animation=false);
  MB.Forces.WorldForce inOther(resolveInFrame=MB.Types.ResolveInFrameB.frame_resolve, animation=false);
  MB.Forces.WorldTorque torqueInWorld(animation=false);
  MB.Forces.WorldTorque torqueInOther(resolveInFrame=MB.Types.ResolveInFrameB.frame_resolve, animation=false);
  MB.Forces.WorldForceAndTorque both(animation=false);
  MB.Forces.WorldForceAndTorque bothInOther(resolveInFrame=MB.Types.ResolveInFrameB.frame_resolve, animation=false);
equation
  connect(world.frame_b, resolve.frame_a);
  connect(resolve.frame_b, inOther.frame_resolve);
  connect(resolve.frame_b, torqueInOther.frame_resolve);
  connect(resolve.frame_b, bothInOther.frame_resolve);
  connect(inWorld.frame_b, body.frame_a);
  connect(inBody.frame_b, body.frame_a);
  connect(inOther.frame_b, body.frame_a);
  connect(torqueInWorld.frame_b, body.frame_a);
  connect(torqueInOther.frame_b, body.frame_a);
  connect(both.frame_b, body.frame_a);
  connect(bothInOther.frame_b, body.frame_a);
  inWorld.force = {1,2,3};
  inBody.force = {0.5,-0.5,0.2};
  inOther.force = {1,0,0};
  torqueInWorld.torque = {0.1,0,0};
  torqueInOther.torque = {0,0.1,0};
  both.force = {0,0,1};
  both.torque = {0,0,0.1};
  bothInOther.force = {0,1,0};
  bothInOther.torque = {0.1,0.1,0};
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end WorldForces;
