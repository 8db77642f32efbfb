package StudyScenes "Scenes of mechanisms whose motion is known, or that peers are shown on"
  import MB = Modelica.Mechanics.MultiBody;
  import SI = Modelica.Units.SI;

  model CamAndFollower "A disc turns about a point beside its centre and lifts a flat follower"
    parameter SI.Radius radius=0.05 "Radius of the disc";
    parameter SI.Distance eccentricity=0.02 "From the axis to the disc's centre";
    parameter SI.AngularVelocity w=10 "Speed of the shaft";
    final parameter SI.Length thickness=0.02 "Of the follower";
    final parameter SI.Mass m=1 "Mass of the follower";
    final parameter Real K(unit="N/m")=1e6 "Stiffness";
    inner MB.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
    MB.Joints.Revolute shaft(useAxisFlange=true, n={0,1,0}, phi(start=0, fixed=true), animation=false);
    Modelica.Mechanics.Rotational.Sources.ConstantSpeed drive(w_fixed=w);
    ContactMultiBody.Parts.Body cam(
      m=1,
      r_CM={eccentricity,0,0},
      I_11=1e-3,
      I_22=1e-3,
      I_33=1e-3,
      geometry=ContactMultiBody.Shapes.cylinder(radius, 0.02, {eccentricity,0,0}, [1,0,0; 0,0,-1; 0,1,0]),
      animation=false);
    MB.Joints.Prismatic guide(
      n={0,0,1},
      s(start=radius + thickness/2 - m*world.g/K, fixed=true),
      v(start=-eccentricity*w, fixed=true),
      animation=false);
    ContactMultiBody.Parts.Body follower(
      m=m,
      r_CM={0,0,0},
      I_11=1e-3,
      I_22=1e-3,
      I_33=1e-3,
      geometry=ContactMultiBody.Shapes.box({0.12,0.03,thickness}),
      animation=false);
    ContactMultiBody.ContactManager contacts(
      n=2,
      geometry={follower.geometry,cam.geometry},
      material={follower.material,cam.material},
      stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
      stiffness={K},
      friction=ContactMultiBody.Types.Friction.None);
  equation
    connect(drive.flange, shaft.axis);
    connect(world.frame_b, shaft.frame_a);
    connect(shaft.frame_b, cam.frame_a);
    connect(world.frame_b, guide.frame_a);
    connect(guide.frame_b, follower.frame_a);
    connect(follower.frame_a, contacts.frame[1]);
    connect(cam.frame_a, contacts.frame[2]);
    annotation (experiment(StopTime=0.7, Tolerance=1e-6, Interval=0.002));
  end CamAndFollower;

  model Gripper "Two fingers press a block between them, and a force lifts all"
    final parameter SI.Length size[3]={0.04,0.03,0.06} "Size of the block";
    final parameter SI.Mass m=0.5 "Mass of the block";
    final parameter SI.Mass m_finger=0.2 "Mass of a finger";
    final parameter SI.Mass m_carriage=1 "Mass of what holds the fingers";
    parameter SI.Force grip=20 "Force of each finger";
    parameter SI.Acceleration rise=1 "Upward, while nothing slips";
    parameter Real mu(unit="1")=0.5 "Coefficient of friction";
    final parameter Real K(unit="N/m")=1e6 "Stiffness";
    final parameter SI.Length half=0.005 "Half the thickness of a finger";
    inner MB.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
    MB.Joints.Prismatic hoist(useAxisFlange=true, n={0,0,1}, s(start=0, fixed=true), v(start=0, fixed=true), animation=false);
    Modelica.Mechanics.Translational.Sources.ConstantForce pull(f_constant=(m + 2*m_finger + m_carriage)*(world.g + rise));
    MB.Parts.Body carriage(m=m_carriage, r_CM={0,0,0}, I_11=1e-3, I_22=1e-3, I_33=1e-3, animation=false);
    MB.Joints.Prismatic left(
      useAxisFlange=true, n={1,0,0}, s(start=-size[1]/2 - half + grip/K, fixed=true), v(start=0, fixed=true), animation=false);
    MB.Joints.Prismatic right(
      useAxisFlange=true, n={1,0,0}, s(start=size[1]/2 + half - grip/K, fixed=true), v(start=0, fixed=true), animation=false);
    Modelica.Mechanics.Translational.Sources.ConstantForce push_left(f_constant=grip);
    Modelica.Mechanics.Translational.Sources.ConstantForce push_right(f_constant=-grip);
    ContactMultiBody.Parts.Body finger[2](
      each m=m_finger,
      each r_CM={0,0,0},
      each I_11=1e-4,
      each I_22=1e-4,
      each I_33=1e-4,
      each geometry=ContactMultiBody.Shapes.box({2*half,0.02,0.04}),
      each material=ContactMultiBody.Materials.Material(restitution=0.2, muStatic=mu),
      each animation=false);
    ContactMultiBody.Parts.Body load(
      m=m,
      r_CM={0,0,0},
      I_11=m*(size[2]^2 + size[3]^2)/12,
      I_22=m*(size[1]^2 + size[3]^2)/12,
      I_33=m*(size[1]^2 + size[2]^2)/12,
      geometry=ContactMultiBody.Shapes.box(size),
      material=ContactMultiBody.Materials.Material(restitution=0.2, muStatic=mu),
      r_0(start={0,0,0}, each fixed=true),
      v_0(each fixed=true),
      angles_fixed=true,
      w_0_fixed=true,
      animation=false);
    ContactMultiBody.ContactManager contacts(
      n=3,
      geometry={finger[1].geometry,finger[2].geometry,load.geometry},
      material={finger[1].material,finger[2].material,load.material},
      pairs={{3,1},{3,2}},
      stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
      stiffness={K,K},
      friction=ContactMultiBody.Types.Friction.Anchored);
  equation
    connect(pull.flange, hoist.axis);
    connect(world.frame_b, hoist.frame_a);
    connect(hoist.frame_b, carriage.frame_a);
    connect(hoist.frame_b, left.frame_a);
    connect(hoist.frame_b, right.frame_a);
    connect(push_left.flange, left.axis);
    connect(push_right.flange, right.axis);
    connect(left.frame_b, finger[1].frame_a);
    connect(right.frame_b, finger[2].frame_a);
    connect(finger[1].frame_a, contacts.frame[1]);
    connect(finger[2].frame_a, contacts.frame[2]);
    connect(load.frame_a, contacts.frame[3]);
    annotation (experiment(StopTime=1, Tolerance=1e-6, Interval=0.005));
  end Gripper;

  function bowlMesh "A spherical bowl as a closed mesh: descriptor"
    extends Modelica.Icons.Function;
    input Integer n "Edges around, four times as many as from the bottom to the rim";
    input SI.Radius R "Radius of the bowl";
    input SI.Angle opening "From the bottom to the rim, about the bowl's centre";
    input SI.Distance thickness "Of the bottom";
    output String geometry "Descriptor";
  protected
    Integer rings=div(n, 4);
    SI.Position points[(div(n, 4) + 1)*n + 2, 3]=zeros((div(n, 4) + 1)*n + 2, 3)
      "The bottom within and without, rings from it to the rim, the edge below";
    Integer triangles[2*(div(n, 4) + 1)*n, 3]=fill(1, 2*(div(n, 4) + 1)*n, 3);
    SI.Angle polar;
    SI.Angle around;
    Integer a;
    Integer b;
    Integer row;
  algorithm
    points[1, :] := {0,0,0};
    points[2, :] := {0,0,-thickness};
    for k in 1:rings + 1 loop
      polar := opening*min(k, rings)/rings;
      for i in 1:n loop
        around := 2*Modelica.Constants.pi*i/n;
        points[2 + (k - 1)*n + i, :] := {R*sin(polar)*cos(around),R*sin(polar)*sin(around),
          if k > rings then -thickness else R*(1 - cos(polar))};
      end for;
    end for;
    for i in 1:n loop
      a := 2 + i;
      b := 3 + mod(i, n);
      triangles[i, :] := {1,a,b};
      triangles[n + i, :] := {2,b + rings*n,a + rings*n};
      for k in 1:rings loop
        row := 2*n*k + 2*i - 1;
        triangles[row, :] := {a + (k - 1)*n,a + k*n,b + k*n};
        triangles[row + 1, :] := {a + (k - 1)*n,b + k*n,b + (k - 1)*n};
      end for;
    end for;
    geometry := ContactMultiBody.Shapes.mesh(points, triangles);
  end bowlMesh;

  model BallInBowl "A ball slides to and fro in a spherical bowl that is a closed mesh"
    parameter Integer n=64 "Edges around the bowl" annotation (Evaluate=true);
    final parameter SI.Radius R=0.5 "Radius of the bowl";
    final parameter SI.Radius r=0.05 "Radius of the ball";
    final parameter SI.Angle theta=0.2 "Of the ball about the bowl's centre, at the start";
    final parameter SI.Mass m=1 "Mass of the ball";
    final parameter Real K(unit="N/m")=1e7 "Stiffness";
    inner MB.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
    ContactMultiBody.Parts.Body ball(
      m=m,
      r_CM={0,0,0},
      I_11=0.4*m*r^2,
      I_22=0.4*m*r^2,
      I_33=0.4*m*r^2,
      geometry=ContactMultiBody.Shapes.sphere(r),
      r_0(start={(R - r)*sin(theta),0,R - (R - r)*cos(theta)}, each fixed=true),
      v_0(each fixed=true),
      angles_fixed=true,
      w_0_fixed=true,
      animation=false);
    ContactMultiBody.Parts.Ground bowl(
      geometry=bowlMesh(n, R, 0.4, 0.05));
    ContactMultiBody.ContactManager contacts(
      n=2,
      geometry={ball.geometry,bowl.geometry},
      material={ball.material,bowl.material},
      stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
      stiffness={K},
      friction=ContactMultiBody.Types.Friction.None);
  equation
    connect(ball.frame_a, contacts.frame[1]);
    connect(bowl.frame_a, contacts.frame[2]);
    annotation (experiment(StopTime=1.2, Tolerance=1e-6, Interval=0.005));
  end BallInBowl;

  model TippeTop "A sphere that is heaviest below its centre spins until it stands on its head"
    final parameter SI.Radius R=0.02 "Radius of the sphere";
    final parameter SI.Distance e=0.003 "From the centre of mass to the sphere's centre";
    final parameter SI.Mass m=0.02 "Mass";
    final parameter SI.MomentOfInertia I=0.4*m*R^2 "Moment of inertia about any axis";
    parameter SI.Angle tilt=0.1 "Of the axis, at the start";
    parameter SI.AngularVelocity spin=100 "About the axis, at the start";
    parameter Real mu(unit="1")=0.3 "Coefficient of friction";
    final parameter Real K(unit="N/m")=1e5 "Stiffness";
    inner MB.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
    ContactMultiBody.Parts.Body top(
      m=m,
      r_CM={0,0,-e},
      I_11=I,
      I_22=I,
      I_33=I,
      geometry=ContactMultiBody.Shapes.sphere(R),
      material=ContactMultiBody.Materials.Material(restitution=0, muStatic=mu),
      r_0(start={0,0,R - m*world.g/K}, each fixed=true),
      v_0(each fixed=true),
      angles_fixed=true,
      angles_start={0,tilt,0},
      w_0_fixed=true,
      w_0_start={spin*sin(tilt),0,spin*cos(tilt)},
      animation=false);
    ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=0, muStatic=mu));
    ContactMultiBody.ContactManager contacts(
      n=2,
      collider={top.collider,floor.collider},
      pointCapacity=1,
      stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
      stiffness={K},
      regularisationSpeed=0.1,
      restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless);
    Real up[3](each unit="1") "Upwards, in the top's frame";
    Real jellett(unit="1") "Angular momentum along the line from the centre of mass to the contact, by that at the start";
  equation
    up = MB.Frames.resolve2(top.frame_a.R, {0,0,1});
    jellett = I*(top.w_a*({0,0,e} - R*up))/(I*spin*(e - R*cos(tilt)));
    connect(top.frame_a, contacts.frame[1]);
    connect(floor.frame_a, contacts.frame[2]);
    annotation (experiment(StopTime=2, Tolerance=1e-6, Interval=0.002));
  end TippeTop;

  model DominoRow "The first of a row of dominoes falls against the next"
    final parameter Integer n=4 "Number of dominoes" annotation (Evaluate=true);
    final parameter SI.Length size[3]={0.0075,0.024,0.048} "Size of a domino";
    final parameter SI.Distance spacing=0.02 "From each domino to the next";
    final parameter SI.Mass m=0.01 "Mass of a domino";
    final parameter Real K(unit="N/m")=1e5 "Stiffness";
    parameter SI.AngularVelocity w=6 "Of the first domino at the start";
    inner MB.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
    ContactMultiBody.Parts.Body domino[n](
      each m=m,
      each r_CM={0,0,0},
      each I_11=m*(size[2]^2 + size[3]^2)/12,
      each I_22=m*(size[1]^2 + size[3]^2)/12,
      each I_33=m*(size[1]^2 + size[2]^2)/12,
      each geometry=ContactMultiBody.Shapes.box(size),
      each material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=0.3),
      r_0(start={{spacing*(i - 1),0,size[3]/2 - m*world.g/K} for i in 1:n}, each fixed=true),
      v_0(start={{if i == 1 then w*size[3]/2 else 0,0,0} for i in 1:n}, each fixed=true),
      each angles_fixed=true,
      each w_0_fixed=true,
      w_0_start={{0,if i == 1 then w else 0,0} for i in 1:n},
      each animation=false);
    ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=0.3));
    ContactMultiBody.ContactManager contacts(
      n=n + 1,
      collider={domino[1].collider,domino[2].collider,domino[3].collider,domino[4].collider,floor.collider},
      pairs={{1,5},{2,5},{3,5},{4,5},{1,2},{2,3},{3,4}},
      stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
      stiffness=fill(K, 7),
      restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless);
  equation
    for i in 1:n loop
      connect(domino[i].frame_a, contacts.frame[i]);
    end for;
    connect(floor.frame_a, contacts.frame[n + 1]);
    annotation (experiment(StopTime=0.25, Tolerance=1e-6, Interval=0.002));
  end DominoRow;

  model FourBarOnStop "The rocker of a four-bar linkage swings against a stop"
    extends ReferenceModels.PlanarFourBar;
    final parameter Real K(unit="N/m")=1e6 "Stiffness";
    ContactMultiBody.ContactManager contacts(
      n=2,
      geometry={ContactMultiBody.Shapes.capsule(0.01, 0.38, {0.2,0,0}, [0,0,-1; 0,1,0; 1,0,0]),
        ContactMultiBody.Shapes.sphere(0.02, {0.6 + 0.3*cos(2.2),0.3*sin(2.2),0})},
      pointCapacity=1,
      stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
      stiffness={K},
      restitution={0.5},
      friction=ContactMultiBody.Types.Friction.None);
  equation
    connect(rocker.frame_a, contacts.frame[1]);
    connect(world.frame_b, contacts.frame[2]);
    annotation (experiment(StopTime=1, Tolerance=1e-6, Interval=0.005));
  end FourBarOnStop;
end StudyScenes;
