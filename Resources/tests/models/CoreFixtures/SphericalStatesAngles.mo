within CoreFixtures;
model SphericalStatesAngles "The same circling body with angles of the joint as states"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(n={0,0,-1}, g=9.81, enableAnimation=false);
  parameter Real tilt=0.7 "Angle from the vertical";
  parameter Real A=0.1 + 1.5*0.8^2 "Inertia about the pivot across the body's axis";
  parameter Real C=0.04 "Inertia about the body's axis";
  parameter Real rate=sqrt(1.5*9.81*0.8/((A - C)*cos(tilt))) "Angular velocity about the vertical for which the body circles";
  MB.Joints.Spherical joint(enforceStates=true, useQuaternions=false, angles_fixed=true, angles_start={0,tilt,0}, w_rel_a_fixed=true,
    w_rel_a_start={0,0,rate}, animation=false);
  MB.Parts.Body body(r_CM={0,0,-0.8}, m=1.5, I_11=0.1, I_22=0.1, I_33=C, animation=false);
equation
  connect(world.frame_b, joint.frame_a);
  connect(joint.frame_b, body.frame_a);
  annotation (experiment(StopTime=2, Tolerance=1e-9));
end SphericalStatesAngles;
