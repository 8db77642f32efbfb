within CoreFixtures;
model FreeBodyQuaternions "Symmetric free body, quaternions: regular precession"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(gravityType=MB.Types.GravityTypes.NoGravity, enableAnimation=false);
  MB.Parts.Body body(m=1, r_CM={0,0,0}, I_11=0.2, I_22=0.2, I_33=0.3, r_0(start={1,2,3}, each fixed=true), v_0(start={0.1,0.2,0.3}, each fixed=true),
    useQuaternions=true, enforceStates=false, sequence_angleStates={3,1,2}, angles_fixed=true, angles_start={0.2,0.3,0.4}, w_0_fixed=true,
    w_0_start={0.5,0.4,3}, animation=false);
  annotation (experiment(StopTime=2, Tolerance=1e-9));
end FreeBodyQuaternions;
