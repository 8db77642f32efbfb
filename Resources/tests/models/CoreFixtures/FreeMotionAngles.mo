within CoreFixtures;
model FreeMotionAngles "Symmetric body, free through a FreeMotion joint with angles: regular precession"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(gravityType=MB.Types.GravityTypes.NoGravity, enableAnimation=false);
  MB.Joints.FreeMotion joint(useQuaternions=false, angles_fixed=true, angles_start={0.2,0.3,0.4}, w_rel_a_fixed=true, w_rel_a_start={0.5,0.4,3},
    r_rel_a(start={1,2,3}, each fixed=true), v_rel_a(start={0.1,0.2,0.3}, each fixed=true), animation=false);
  MB.Parts.Body body(m=1, r_CM={0,0,0}, I_11=0.2, I_22=0.2, I_33=0.3, animation=false);
equation
  connect(world.frame_b, joint.frame_a);
  connect(joint.frame_b, body.frame_a);
  annotation (experiment(StopTime=2, Tolerance=1e-9));
end FreeMotionAngles;
