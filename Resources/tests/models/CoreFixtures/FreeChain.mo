within CoreFixtures;
model FreeChain "Free body that carries another one through joints and fixed frames in both directions"
  extends Modelica.Icons.Example;
  import MB = Modelica.Mechanics.MultiBody;
  inner MB.World world(n={0,0,-1}, g=9.81, enableAnimation=false);
  MB.Parts.Body base(m=3, r_CM={0.1,0,0}, I_11=0.2, I_22=0.3, I_33=0.4, r_0(each fixed=true), v_0(start={1,2,3}, each fixed=true), angles_fixed=true,
    angles_start={0.1,0.2,0.3}, w_0_fixed=true, w_0_start={1,-1,0.5}, enforceStates=true, animation=false);
  MB.Parts.FixedRotation bend(r={0.2,0.1,0}, rotationType=MB.Types.RotationTypes.TwoAxesVectors, n_x={0,1,0.2}, n_y={0,0,1}, animation=false);
  MB.Joints.Revolute joint(n={1,2,3}, phi(fixed=true, start=0.2), w(fixed=true, start=1), animation=false);
  MB.Parts.FixedRotation back(r={0.1,0.2,0.3}, rotationType=MB.Types.RotationTypes.PlanarRotationSequence, sequence={3,2,1}, angles={20,30,-40}, animation=false);
  MB.Joints.Prismatic slide(n={0,1,1}, s(fixed=true), v(fixed=true, start=0.3), animation=false);
  MB.Parts.FixedTranslation rod(r={0.3,0,0.1}, animation=false);
  MB.Parts.FixedRotation turn(rotationType=MB.Types.RotationTypes.RotationAxis, n={1,1,0}, angle=50, animation=false);
  MB.Parts.BodyShape load(m=1, r={0.1,0.1,0.1}, r_CM={0.05,0.1,0}, I_11=0.02, I_22=0.03, I_33=0.04, I_21=0.001, I_31=0.002, I_32=-0.003, animation=false);
  SI.Momentum momentum[3] = base.m*(base.v_0 + MB.Frames.resolve1(base.frame_a.R, cross(base.w_a, base.r_CM))) + load.m*(load.v_0 +
    MB.Frames.resolve1(load.frame_a.R, cross(load.body.w_a, load.r_CM))) "Total momentum";
equation
  connect(base.frame_a, bend.frame_b);
  connect(bend.frame_a, joint.frame_b);
  connect(joint.frame_a, back.frame_a);
  connect(back.frame_b, slide.frame_b);
  connect(slide.frame_a, rod.frame_b);
  connect(rod.frame_a, turn.frame_b);
  connect(turn.frame_a, load.frame_a);
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end FreeChain;
