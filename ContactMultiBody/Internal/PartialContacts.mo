within ContactMultiBody.Internal;
partial model PartialContacts "Forces between bodies from depths, normals and points that an extending model provides"
  import SI = Modelica.Units.SI;
  import Modelica.Mechanics.MultiBody.Frames;

  parameter Integer n(min=2)=2 "Number of bodies" annotation (Evaluate=true);
  parameter Materials.Material material[n] "Material of each body, usually {body1.material, ...}";
  parameter Integer pairs[:, 2]=fill(0, 0, 2) "Pairs of bodies that may touch; empty: all pairs" annotation (Evaluate=true);
  final parameter Integer m=if size(pairs, 1) > 0 then size(pairs, 1) else div(n*(n - 1), 2) "Number of pairs"
    annotation (Evaluate=true);
  final parameter Integer pair[m, 2]=pairsLookedAt(pairs, n, m) "Bodies of each pair" annotation (Evaluate=true);
  parameter Integer pointCapacity(min=1)=4 "Largest number of contact points of a pair" annotation (Evaluate=true);

  parameter Types.NormalLaw normalLaw=Types.NormalLaw.Exact "Law of the normal force"
    annotation (Evaluate=true, Dialog(group="Normal force"));
  parameter Types.StiffnessChoice stiffnessChoice=Types.StiffnessChoice.Hertz "Where the stiffness comes from"
    annotation (Evaluate=true, Dialog(group="Normal force"));
  parameter Real exponent(min=1, unit="1")=if stiffnessChoice == Types.StiffnessChoice.Hertz then 1.5 else 1
    "Exponent of the depth" annotation (Dialog(group="Normal force"));
  parameter SI.Radius contactRadius[m]=fill(0.01, m) "Radius of curvature of each pair's contact"
    annotation (Dialog(group="Normal force", enable=stiffnessChoice == Types.StiffnessChoice.Hertz));
  parameter Real stiffness[m](each min=0)=if stiffnessChoice == Types.StiffnessChoice.Hertz then Materials.pairHertzStiffness(
      material.E, material.nu, pair, contactRadius) else fill(1e6, m) "Stiffness of each pair in N/m^exponent"
    annotation (Dialog(group="Normal force", enable=stiffnessChoice == Types.StiffnessChoice.Given));
  parameter SI.TranslationalDampingConstant damping[m](each min=0)=fill(1e3, m) "Damping constant of each pair, for SpringDamper only"
    annotation (Dialog(group="Normal force", enable=normalLaw == Types.NormalLaw.SpringDamper));
  parameter SI.Length dampingDepth(min=Modelica.Constants.small)=1e-4
    "Depth from which dampers act fully, for SpringDamper only"
    annotation (Dialog(group="Normal force", enable=normalLaw == Types.NormalLaw.SpringDamper));

  parameter Boolean useRestitution=true
    "= true, if impacts deliver the coefficients of restitution; without effect for SpringDamper"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(group="Restitution"));
  parameter Types.RestitutionMethod restitutionMethod=Types.RestitutionMethod.ImpactSpeed
    "How the speed at the start of a contact is known"
    annotation (Evaluate=true, Dialog(group="Restitution", enable=useRestitution));
  parameter Types.CombinationRule restitutionRule=Types.CombinationRule.Minimum "How restitution of two materials combines"
    annotation (Evaluate=true, Dialog(group="Restitution", enable=useRestitution));
  parameter Real restitution[m](each min=0, each max=1, each unit="1")=Materials.combine(
    material.restitution, pair, restitutionRule) "Coefficient of restitution of each pair"
    annotation (Dialog(group="Restitution", enable=useRestitution));
  parameter SI.Velocity restSpeed(min=Modelica.Constants.small)=0.01 "Impacts slower than this come to rest, for ImpactSpeed only"
    annotation (Dialog(group="Restitution", enable=useRestitution));
  parameter Parts.Inertia inertia[n] "Inertia of each body, usually {body1.inertia, ...}, for Memoryless only"
    annotation (Dialog(group="Restitution", enable=restitutionMethod == Types.RestitutionMethod.Memoryless));
  parameter SI.Mass effectiveMass[m](each min=0)=fill(0, m)
    "Effective mass of each pair; 0: computed from the bodies' inertia where they touch, for Memoryless only"
    annotation (Dialog(group="Restitution", enable=restitutionMethod == Types.RestitutionMethod.Memoryless));
  parameter Real steadyRate[m](each min=0, each unit="s/m")=fill(0.5, m)
    "Damping D of each pair in F = K x^n (1 + D dx/dt), where restitution is not used"
    annotation (Dialog(group="Restitution", enable=not useRestitution));

  parameter Types.Friction friction=Types.Friction.Regularised "Law of friction"
    annotation (Evaluate=true, Dialog(group="Friction"));
  parameter Types.CombinationRule frictionRule=Types.CombinationRule.GeometricMean "How friction of two materials combines"
    annotation (Evaluate=true, Dialog(group="Friction", enable=friction <> Types.Friction.None));
  parameter Real muStatic[m](each min=0, each unit="1")=Materials.combine(material.muStatic, pair, frictionRule)
    "Coefficient of static friction of each pair, for Anchored only"
    annotation (Dialog(group="Friction", enable=friction == Types.Friction.Anchored));
  parameter Real muDynamic[m](each min=0, each unit="1")=Materials.combine(material.muDynamic, pair, frictionRule)
    "Coefficient of sliding friction of each pair"
    annotation (Dialog(group="Friction", enable=friction <> Types.Friction.None));
  parameter SI.Velocity regularisationSpeed(min=Modelica.Constants.small)=1e-3
    "Sliding speed over which regularised friction changes its direction"
    annotation (Dialog(group="Friction", enable=friction == Types.Friction.Regularised));
  parameter SI.Velocity limitSpeed(min=Modelica.Constants.small)=0.01
    "Sliding speed that separates static from sliding friction, for Anchored only"
    annotation (Dialog(group="Friction", enable=friction == Types.Friction.Anchored));
  parameter SI.TranslationalSpringConstant frictionStiffness[m](each min=Modelica.Constants.small)=0.8*1e-4^(exponent - 1)*stiffness
    "Stiffness of each static spring, for Anchored only"
    annotation (Dialog(group="Friction", enable=friction == Types.Friction.Anchored));
  parameter SI.Time frictionDampingTime(min=0)=1e-3 "Damping of the static springs by their stiffness, for Anchored only"
    annotation (Dialog(group="Friction", enable=friction == Types.Friction.Anchored));
  parameter SI.Time relaxationTime(min=Modelica.Constants.small)=1e-3
    "Time in which an anchor that holds nothing is forgotten, for Anchored only"
    annotation (Dialog(group="Friction", enable=friction == Types.Friction.Anchored));
  parameter Boolean useTurningFriction=false "= true, if torques act against spin and rolling"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(group="Spin and rolling friction"));
  parameter SI.Radius spinRadius[m](each min=0)=fill(0, m) "Radius of each pair's area of contact; 0: no spin friction"
    annotation (Dialog(group="Spin and rolling friction", enable=useTurningFriction));
  parameter SI.Length rollingLever[m](each min=0)=fill(0, m) "Coefficient of rolling friction of each pair, a length; 0: none"
    annotation (Dialog(group="Spin and rolling friction", enable=useTurningFriction));
  parameter SI.AngularVelocity turningRegularisationSpeed(min=Modelica.Constants.small)=1e-2
    "Angular speed over which torques of friction change their direction"
    annotation (Dialog(group="Spin and rolling friction", enable=useTurningFriction));

  final parameter Boolean catchImpacts=useRestitution and normalLaw <> Types.NormalLaw.SpringDamper and restitutionMethod
       == Types.RestitutionMethod.ImpactSpeed "= true, if events catch the speeds of impacts" annotation (Evaluate=true);
  final parameter Real dampingFactor[m](each unit="1")=dampingFactors(normalLaw, restitution) "Damping factor of each pair";

  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame[n] "Frames of the bodies"
    annotation (Placement(transformation(extent={{-116,-80},{-84,80}})));

  SI.Length distance[m] "Signed distance of each pair, negative when penetrating";
  SI.Force normalForce[m] "Normal force of each pair, summed over its points";
  SI.Force force[m, 3] "Force on the first body of each pair, in world axes";
  SI.Velocity approachSpeed[m] "Speed at which the bodies of each pair approach where they touch";
  SI.Velocity impactSpeed[if catchImpacts then m else 0]
    "Approach speed of each pair when it last was struck";
  Boolean touches[if catchImpacts then m else 0] "= true, if the bodies of the pair touch";
  SI.Energy elasticEnergy "Energy stored in the compliance of all contacts";
  SI.Position anchorStretch[if friction == Types.Friction.Anchored then m else 0, 3](each start=0, each fixed=true)
    "Way each pair slid since its anchor was set, in world axes";

protected
  final parameter SI.Mass mass[n]=inertia.m "Mass of each body; 0: immovable";
  final parameter SI.Position r_CM[n, 3]=inertia.r_CM "Centre of mass of each body, in its frame";
  final parameter Real inverseInertia[n, 3, 3](each unit="1/(kg.m2)")=inverseTensors(inertia.I)
    "Inverse of each body's tensor of inertia, in its frame";
  final parameter Real logarithmAtSeparation[m](each unit="1")=logarithmsAtSeparation(dampingFactor)
    "ln(1 - d e) of each pair";
  SI.Position r_0[n, 3] "Origins of the bodies' frames";
  SI.Velocity v_0[n, 3] "Velocities of the origins";
  SI.AngularVelocity w_0[n, 3] "Angular velocities, in world axes";
  SI.Length depth[m, pointCapacity] "Penetration depth of each point";
  Real weight[m, pointCapacity](each unit="1") "Share of the law's force each point carries";
  Real normal[m, pointCapacity, 3](each unit="1") "Normal of each point";
  SI.Position point[m, pointCapacity, 3] "Contact points";
  SI.Velocity pointVelocity[m, pointCapacity, 3] "Velocity of first against second body at each point";
  SI.Velocity pointSpeed[m, pointCapacity] "Approach speed at each point";
  SI.Force pointNormalForce[m, pointCapacity] "Normal force of each point";
  SI.Force pointForce[m, pointCapacity, 3] "Force of each point on the first body";
  SI.Force bodyForce[n, 3] "Contact force on each body, in world axes";
  SI.Torque bodyTorque[n, 3] "Contact torque on each body about its frame, in world axes";
  final parameter Boolean isMemoryless=useRestitution and normalLaw <> Types.NormalLaw.SpringDamper and restitutionMethod
       == Types.RestitutionMethod.Memoryless "= true, if restitution is delivered without events" annotation (Evaluate=true);
  SI.Velocity strikeSpeed[if catchImpacts then m else 0] "Greatest approach speed of the points where each pair touches";
  Boolean struck[if catchImpacts then m else 0] "= true, if a touching pair meets faster than when it last was struck";
  Real rate[if catchImpacts then m else 0](each unit="s/m") "Damping factor by impact speed of each pair";
  SI.Acceleration springDeceleration[if isMemoryless then m else 0, pointCapacity]
    "Deceleration of each point by the springs of its pair";
  Real meanNormal[if friction == Types.Friction.Anchored then m else 0, 3](each unit="1") "Normal of each pair as a whole";
  SI.Velocity sliding[if friction == Types.Friction.Anchored then m else 0, 3] "Tangential velocity of each pair as a whole";
  SI.AngularVelocity spin[if friction == Types.Friction.Anchored then m else 0] "Mean angular velocity about the normal";
  Real mu[if friction == Types.Friction.Anchored then m else 0](each unit="1") "Coefficient of friction at the present speed";
initial equation
  if catchImpacts then
    pre(impactSpeed) = strikeSpeed;
  end if;
equation
  for i in 1:n loop
    r_0[i, :] = frame[i].r_0;
    w_0[i, :] = Frames.resolve1(frame[i].R, frame[i].R.w);
  end for;
  v_0 = der(r_0);

  if isMemoryless then
    for i in 1:m loop
      assert(effectiveMass[i] > 0 or mass[pair[i, 1]] > 0 or mass[pair[i, 2]] > 0,
        "Restitution without events needs masses: give the manager inertia={body1.inertia, ...} or effectiveMass.");
    end for;
  end if;

  pointVelocity = pointVelocities(point, r_0, v_0, w_0, pair);
  pointSpeed = approachSpeeds(pointVelocity, normal);
  approachSpeed = pairApproachSpeeds(pointSpeed, weight);

  if catchImpacts then
    for i in 1:m loop
      touches[i] = distance[i] < 0;
    end for;
    strikeSpeed = strikeSpeeds(depth, pointSpeed);
    for i in 1:m loop
      struck[i] = strikeSpeed[i] > 1.25*max(pre(impactSpeed[i]), restSpeed) and distance[i] < 0;
    end for;
    when touches then
      impactSpeed = caughtSpeeds(touches, pre(touches), struck, strikeSpeed, pre(impactSpeed));
    elsewhen struck then
      impactSpeed = caughtSpeeds(touches, pre(touches), struck, strikeSpeed, pre(impactSpeed));
    end when;
    for i in 1:m loop
      rate[i] = NormalForce.dampingRate(dampingFactor[i], impactSpeed[i], restSpeed);
    end for;
  end if;

  if normalLaw == Types.NormalLaw.SpringDamper then
    pointNormalForce = springDamperForces(depth, weight, pointSpeed, stiffness, exponent, damping, dampingDepth);
  elseif catchImpacts then
    pointNormalForce = normalForces(depth, weight, pointSpeed, stiffness, exponent, rate);
  elseif isMemoryless then
    springDeceleration = springDecelerations(
      depth,
      weight,
      normal,
      point,
      stiffness,
      exponent,
      pair,
      r_0,
      {frame[i].R.T for i in 1:n},
      mass,
      r_CM,
      inverseInertia,
      effectiveMass);
    pointNormalForce = memorylessForces(
      depth,
      weight,
      pointSpeed,
      stiffness,
      exponent,
      springDeceleration,
      dampingFactor,
      logarithmAtSeparation);
  else
    pointNormalForce = normalForces(depth, weight, pointSpeed, stiffness, exponent, steadyRate);
  end if;

  if friction == Types.Friction.None then
    pointForce = frictionlessForces(pointNormalForce, normal);
    elasticEnergy = springEnergy(depth, weight, stiffness, exponent);
  elseif friction == Types.Friction.Regularised then
    pointForce = regularisedForces(pointNormalForce, normal, pointVelocity, pointSpeed, muDynamic, regularisationSpeed);
    elasticEnergy = springEnergy(depth, weight, stiffness, exponent);
  else
    (meanNormal,sliding,spin,mu) = contactMeans(
      pointNormalForce,
      normal,
      pointVelocity,
      w_0,
      pair,
      muStatic,
      muDynamic,
      limitSpeed);
    pointForce = anchoredForces(
      pointNormalForce,
      normal,
      meanNormal,
      sliding,
      anchorStretch,
      frictionStiffness,
      frictionDampingTime,
      mu);
    der(anchorStretch) = anchorRates(
      normalForce,
      anchorStretch,
      sliding,
      meanNormal,
      spin,
      frictionStiffness,
      mu,
      relaxationTime);
    elasticEnergy = springEnergy(depth, weight, stiffness, exponent) + anchorEnergy(anchorStretch, frictionStiffness);
  end if;

  for i in 1:m loop
    normalForce[i] = sum(pointNormalForce[i, :]);
  end for;
  for i in 1:m loop
    force[i, :] = {sum(pointForce[i, :, 1]),sum(pointForce[i, :, 2]),sum(pointForce[i, :, 3])};
  end for;

  bodyForce = bodyForces(pointForce, pair, n);
  if useTurningFriction then
    bodyTorque = bodyTorques(pointForce, point, r_0, pair) + turningTorques(
      pointNormalForce,
      normal,
      w_0,
      pair,
      muDynamic,
      spinRadius,
      rollingLever,
      turningRegularisationSpeed);
  else
    bodyTorque = bodyTorques(pointForce, point, r_0, pair);
  end if;
  for i in 1:n loop
    frame[i].f = -Frames.resolve2(frame[i].R, bodyForce[i, :]);
    frame[i].t = -Frames.resolve2(frame[i].R, bodyTorque[i, :]);
  end for;
  annotation (Documentation(info="<html>
<p>
All of a contact but its geometry. An extending model gives distance, depth, weight, normal and point as functions of the poses.
</p>
</html>"));
end PartialContacts;
