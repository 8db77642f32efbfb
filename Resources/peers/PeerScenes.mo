package PeerScenes "The scenes on which the library is shown beside its peers"
  import MB = Modelica.Mechanics.MultiBody;
  import SI = Modelica.Units.SI;

  model BouncingBall "A ball falls from 1 m"
    parameter Real K(unit="N/m")=1e6 "Stiffness";
    inner MB.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
    ContactMultiBody.Parts.Body body(
      m=1,
      r_CM={0,0,0},
      I_11=0.004,
      I_22=0.004,
      I_33=0.004,
      geometry=ContactMultiBody.Shapes.sphere(0.1),
      r_0(start={0,0,1.1}, each fixed=true),
      v_0(each fixed=true),
      angles_fixed=true,
      w_0_fixed=true,
      animation=false);
    ContactMultiBody.Parts.Ground floor;
    ContactMultiBody.ContactManager contacts(
      n=2,
      collider={body.collider,floor.collider},
      pointCapacity=1,
      stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
      stiffness={K},
      restitution={0.7},
      friction=ContactMultiBody.Types.Friction.None);
  equation
    connect(body.frame_a, contacts.frame[1]);
    connect(floor.frame_a, contacts.frame[2]);
    annotation (experiment(StopTime=1.8, Tolerance=1e-6));
  end BouncingBall;

  model BouncingBallWithoutEvents "The same, restitution without events"
    extends BouncingBall(contacts(restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless));
  end BouncingBallWithoutEvents;

  partial model BoxOnFloor "A box on a floor"
    parameter Real K(unit="N/m")=1e6 "Stiffness";
    parameter SI.Length size[3]={0.2,0.2,0.05} "Size of the box";
    parameter SI.Mass m=1 "Mass of the box";
    parameter SI.Angle slope=0 "Of the floor, as gravity sees it";
    parameter SI.Velocity v0=0 "Speed at the start";
    inner MB.World world(g=9.81, n={sin(slope),0,-cos(slope)}, enableAnimation=false);
    ContactMultiBody.Parts.Body body(
      m=m,
      r_CM={0,0,0},
      I_11=m*(size[2]^2 + size[3]^2)/12,
      I_22=m*(size[1]^2 + size[3]^2)/12,
      I_33=m*(size[1]^2 + size[2]^2)/12,
      geometry=ContactMultiBody.Shapes.box(size),
      r_0(start={0,0,size[3]/2 - m*world.g*cos(slope)/K}, each fixed=true),
      v_0(start={v0,0,0}, each fixed=true),
      angles_fixed=true,
      w_0_fixed=true,
      animation=false);
    ContactMultiBody.Parts.Ground floor;
    replaceable ContactMultiBody.ContactManager contacts(
      n=2,
      collider={body.collider,floor.collider},
      stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
      stiffness={K},
      restitution={0},
      muStatic={0.3},
      muDynamic={0.3},
      friction=ContactMultiBody.Types.Friction.Anchored);
  equation
    connect(body.frame_a, contacts.frame[1]);
    connect(floor.frame_a, contacts.frame[2]);
  end BoxOnFloor;

  model SlidingBlock "A block slides until friction stops it"
    extends BoxOnFloor(v0=2);
    annotation (experiment(StopTime=1, Tolerance=1e-6));
  end SlidingBlock;

  model SlidingBlockRegularised "The same, friction without anchors"
    extends SlidingBlock(contacts(friction=ContactMultiBody.Types.Friction.Regularised));
  end SlidingBlockRegularised;

  model BoxOnIncline "A box rests on 16 degrees"
    extends BoxOnFloor(size={0.2,0.2,0.1}, m=2, slope=0.279252680319093);
    annotation (experiment(StopTime=2, Tolerance=1e-6));
  end BoxOnIncline;

  model BoxOnInclineRegularised "The same, friction without anchors"
    extends BoxOnIncline(contacts(friction=ContactMultiBody.Types.Friction.Regularised));
  end BoxOnInclineRegularised;

  model RollingSphere "A sphere that slides first ends up rolling"
    parameter Real K(unit="N/m")=1e6 "Stiffness";
    inner MB.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
    ContactMultiBody.Parts.Body body(
      m=1,
      r_CM={0,0,0},
      I_11=0.004,
      I_22=0.004,
      I_33=0.004,
      geometry=ContactMultiBody.Shapes.sphere(0.1),
      r_0(start={0,0,0.1 - world.g/K}, each fixed=true),
      v_0(start={2,0,0}, each fixed=true),
      angles_fixed=true,
      w_0_fixed=true,
      animation=false);
    ContactMultiBody.Parts.Ground floor;
    ContactMultiBody.ContactManager contacts(
      n=2,
      collider={body.collider,floor.collider},
      pointCapacity=1,
      stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
      stiffness={K},
      restitution={0},
      muStatic={0.3},
      muDynamic={0.3});
  equation
    connect(body.frame_a, contacts.frame[1]);
    connect(floor.frame_a, contacts.frame[2]);
    annotation (experiment(StopTime=1, Tolerance=1e-6));
  end RollingSphere;

  model StackOfFive "Five boxes fall 1 mm each onto each other"
    parameter Real K(unit="N/m")=1e6 "Stiffness";
    final parameter SI.Length a=0.2 "Edge of the boxes";
    final parameter SI.Mass m=1 "Mass of each box";
    final parameter SI.Position shift[5, 2]=[0,0; 0.01,0; 0,0.01; -0.01,0; 0,-0.01] "Of the boxes at the start";
    inner MB.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
    ContactMultiBody.Parts.Body body[5](
      each m=m,
      each r_CM={0,0,0},
      each I_11=m*a^2/6,
      each I_22=m*a^2/6,
      each I_33=m*a^2/6,
      each geometry=ContactMultiBody.Shapes.box({a,a,a}),
      r_0(start={{shift[i, 1],shift[i, 2],a*(i - 0.5) + 1e-3*i} for i in 1:5}, each fixed=true),
      v_0(each fixed=true),
      each angles_fixed=true,
      each w_0_fixed=true,
      each animation=false);
    ContactMultiBody.Parts.Ground floor;
    ContactMultiBody.ContactManager contacts(
      n=6,
      collider={body[1].collider,body[2].collider,body[3].collider,body[4].collider,body[5].collider,floor.collider},
      pairs={{1,6},{2,1},{3,2},{4,3},{5,4}},
      stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
      stiffness=fill(K, 5),
      restitution=zeros(5),
      muStatic=fill(0.5, 5),
      muDynamic=fill(0.5, 5),
      friction=ContactMultiBody.Types.Friction.Anchored,
      restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless);
  equation
    for i in 1:5 loop
      connect(body[i].frame_a, contacts.frame[i]);
    end for;
    connect(floor.frame_a, contacts.frame[6]);
    annotation (experiment(StopTime=2, Tolerance=1e-6));
  end StackOfFive;

  model NewtonCradle "Five balls on strings, 1 mm apart"
    parameter Real K(unit="N/m")=1e8 "Stiffness";
    final parameter SI.Radius radius=0.02 "Radius of the balls";
    final parameter SI.Length length=0.2 "Length of the strings";
    final parameter SI.Distance gap=1e-3 "Gap between the balls at rest";
    final parameter SI.Mass m=4/3*Modelica.Constants.pi*radius^3*7850 "Mass of a ball";
    inner MB.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
    MB.Parts.FixedTranslation hook[5](r={{(i - 1)*(2*radius + gap),0,0} for i in 1:5}, each animation=false);
    MB.Joints.Revolute string[5](
      each n={0,1,0},
      phi(start={if i == 1 then 0.5 else 0 for i in 1:5}, each fixed=true),
      w(each fixed=true),
      each animation=false);
    ContactMultiBody.Parts.Body ball[5](
      each m=m,
      each r_CM={0,0,-length},
      each I_11=0.4*m*radius^2,
      each I_22=0.4*m*radius^2,
      each I_33=0.4*m*radius^2,
      each geometry=ContactMultiBody.Shapes.sphere(radius, {0,0,-length}),
      each animation=false);
    ContactMultiBody.ContactManager contacts(
      n=5,
      collider={ball[1].collider,ball[2].collider,ball[3].collider,ball[4].collider,ball[5].collider},
      pairs={{i,i + 1} for i in 1:4},
      pointCapacity=1,
      stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
      stiffness=fill(K, 4),
      restitution=ones(4),
      friction=ContactMultiBody.Types.Friction.None);
  equation
    for i in 1:5 loop
      connect(world.frame_b, hook[i].frame_a);
      connect(hook[i].frame_b, string[i].frame_a);
      connect(string[i].frame_b, ball[i].frame_a);
      connect(ball[i].frame_a, contacts.frame[i]);
    end for;
    annotation (experiment(StopTime=0.9, Tolerance=1e-6));
  end NewtonCradle;

  model FallingRod "A rod falls with its end on a floor without friction"
    parameter Real K(unit="N/m")=1e6 "Stiffness";
    final parameter SI.Radius radius=0.01 "Radius of its ends";
    final parameter SI.Angle tilt=0.5 "From the vertical at the start";
    inner MB.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
    ContactMultiBody.Parts.Body body(
      m=1,
      r_CM={0,0,0},
      I_11=1/12,
      I_22=1/12,
      I_33=radius^2/2,
      geometry=ContactMultiBody.Shapes.capsule(radius, 1),
      r_0(start={0,0,radius + 0.5*cos(tilt)}, each fixed=true),
      v_0(each fixed=true),
      angles_fixed=true,
      angles_start={0,tilt,0},
      w_0_fixed=true,
      animation=false);
    ContactMultiBody.Parts.Ground floor;
    ContactMultiBody.ContactManager contacts(
      n=2,
      collider={body.collider,floor.collider},
      stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
      stiffness={K},
      restitution={0},
      friction=ContactMultiBody.Types.Friction.None);
  equation
    connect(body.frame_a, contacts.frame[1]);
    connect(floor.frame_a, contacts.frame[2]);
    annotation (experiment(StopTime=0.3, Tolerance=1e-6));
  end FallingRod;

  model DominoRow "The first of four dominoes falls against the next"
    parameter Real K(unit="N/m")=1e5 "Stiffness";
    final parameter SI.Length size[3]={0.0075,0.024,0.048} "Size of a domino";
    final parameter SI.Mass m=0.01 "Mass of a domino";
    final parameter SI.AngularVelocity w=6 "Of the first domino at the start";
    inner MB.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
    ContactMultiBody.Parts.Body body[4](
      each m=m,
      each r_CM={0,0,0},
      each I_11=m*(size[2]^2 + size[3]^2)/12,
      each I_22=m*(size[1]^2 + size[3]^2)/12,
      each I_33=m*(size[1]^2 + size[2]^2)/12,
      each geometry=ContactMultiBody.Shapes.box(size),
      r_0(start={{0.02*(i - 1),0,size[3]/2 - m*world.g/K} for i in 1:4}, each fixed=true),
      v_0(start={{if i == 1 then w*size[3]/2 else 0,0,0} for i in 1:4}, each fixed=true),
      each angles_fixed=true,
      each w_0_fixed=true,
      w_0_start={{0,if i == 1 then w else 0,0} for i in 1:4},
      each animation=false);
    ContactMultiBody.Parts.Ground floor;
    ContactMultiBody.ContactManager contacts(
      n=5,
      collider={body[1].collider,body[2].collider,body[3].collider,body[4].collider,floor.collider},
      pairs={{1,5},{2,5},{3,5},{4,5},{1,2},{2,3},{3,4}},
      stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
      stiffness=fill(K, 7),
      restitution=fill(0.3, 7),
      muStatic=fill(0.3, 7),
      muDynamic=fill(0.3, 7),
      restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless);
  equation
    for i in 1:4 loop
      connect(body[i].frame_a, contacts.frame[i]);
    end for;
    connect(floor.frame_a, contacts.frame[5]);
    annotation (experiment(StopTime=0.2, Tolerance=1e-6));
  end DominoRow;

  model HundredSpheres "A hundred spheres are thrown on a floor"
    ContactMultiBody.Parts.FreeBodies spheres(
      bodyCount=100,
      bodyGeometry=ContactMultiBody.Shapes.sphere(0.05),
      bodyMass=0.5,
      bodyInertia=fill(0.4*0.5*0.05^2, 3),
      surroundings=ContactMultiBody.Shapes.halfSpace(),
      material(each restitution=0.3, each muStatic=0.5, each muDynamic=0.5),
      stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
      bodyStiffness=2e4,
      regularisationSpeed=0.02,
      r_start={{0.12*mod(i - 1, 10),0.12*div(i - 1, 10),0.06 + 0.03*mod(7*i, 11)} for i in 1:100},
      v_start={{sin(1.7*i),cos(2.3*i),0} for i in 1:100});
    annotation (experiment(StopTime=1, Tolerance=1e-6));
  end HundredSpheres;
end PeerScenes;
