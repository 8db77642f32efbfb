within CoreFixtures;
model LineForces "Springs and dampers between points"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(n={0,0,-1}, g=9.81, enableAnimation=false);
  MB.Parts.Fixed support(r={0,0,2}, animation=false);
  MB.Forces.SpringDamperParallel springDamper(c=40, s_unstretched=0.5, d=2, fixedRotationAtFrame_b=true, animation=false);
  MB.Parts.PointMass upper(m=1, r_0(start={0.1,0,1.4}, each fixed=true), v_0(each fixed=true), stateSelect=StateSelect.always, animation=false);
  MB.Forces.Spring spring(c=30, s_unstretched=0.4, m=0.2, lengthFraction=0.3, animation=false);
  MB.Parts.Body lower(m=0.8, r_CM={0.05,0,-0.1}, I_11=0.02, I_22=0.02, I_33=0.01, r_0(start={0.2,0.1,0.9}, each fixed=true), v_0(each fixed=true),
    angles_fixed=true, w_0_fixed=true, animation=false);
  MB.Forces.Damper damper(d=1.5, animation=false);
  MB.Parts.Fixed ground(animation=false);
  Real energy = 0.5*upper.m*upper.v_0*upper.v_0 "Part of the energy";
equation
  connect(support.frame_b, springDamper.frame_a);
  connect(springDamper.frame_b, upper.frame_a);
  connect(upper.frame_a, spring.frame_a);
  connect(spring.frame_b, lower.frame_a);
  connect(lower.frame_a, damper.frame_a);
  connect(damper.frame_b, ground.frame_b);
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end LineForces;
