within ContactMultiBody.Interfaces;
partial model PartialCompiledContacts "Parameters of contacts that the engine computes, and its wrenches on all bodies"
  import SI = Modelica.Units.SI;

  parameter Integer n(min=2)=2 "Number of bodies" annotation (Evaluate=true);
  parameter String geometry[n] "Descriptor of each body's geometry";
  parameter Materials.Material material[n] "Material of each body";
  parameter Parts.Inertia inertia[n] "Inertia of each body; bodies of mass 0 are immovable";

  parameter Integer group[n]=fill(1, n) "Groups each body belongs to, one bit each"
    annotation (Evaluate=true, Dialog(group="Pairs that never touch"));
  parameter Integer collidesWith[n]=fill(-1, n) "Groups each body collides with, one bit each; -1: all"
    annotation (Evaluate=true, Dialog(group="Pairs that never touch"));
  parameter Integer excluded[:, 2]=fill(0, 0, 2) "Pairs of bodies that never touch, as neighbours in a joint"
    annotation (Evaluate=true, Dialog(group="Pairs that never touch"));

  parameter Types.NormalLaw normalLaw=Types.NormalLaw.Exact "Law of the normal force"
    annotation (Evaluate=true, Dialog(group="Normal force"));
  parameter Types.StiffnessChoice stiffnessChoice=Types.StiffnessChoice.Hertz "Where the stiffness comes from"
    annotation (Evaluate=true, Dialog(group="Normal force"));
  parameter Real exponent(min=1, unit="1")=if stiffnessChoice == Types.StiffnessChoice.Hertz then 1.5 else 1
    "Exponent of the depth" annotation (Dialog(group="Normal force"));
  parameter SI.Radius contactRadius[n]=fill(0.02, n) "Radius of curvature of each body's surface; Modelica.Constants.inf: flat"
    annotation (Dialog(group="Normal force", enable=stiffnessChoice == Types.StiffnessChoice.Hertz));
  parameter Real stiffness[n](each min=0)=fill(2e6, n)
    "Stiffness of each body against a rigid one in N/m^exponent; two bodies act in series; Modelica.Constants.inf: rigid"
    annotation (Dialog(group="Normal force", enable=stiffnessChoice == Types.StiffnessChoice.Given));
  parameter SI.TranslationalDampingConstant damping(min=0)=1e3 "Damping constant, for SpringDamper only"
    annotation (Dialog(group="Normal force", enable=normalLaw == Types.NormalLaw.SpringDamper));
  parameter SI.Length dampingDepth(min=Modelica.Constants.small)=1e-4
    "Depth from which dampers act fully, for SpringDamper only"
    annotation (Dialog(group="Normal force", enable=normalLaw == Types.NormalLaw.SpringDamper));

  parameter Boolean useRestitution=true
    "= true, if impacts deliver the coefficients of restitution; without effect for SpringDamper"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(group="Restitution"));
  parameter Types.CombinationRule restitutionRule=Types.CombinationRule.Minimum "How restitution of two materials combines"
    annotation (Evaluate=true, Dialog(group="Restitution", enable=useRestitution));
  parameter Real steadyRate(min=0, unit="s/m")=0.5 "Damping D in F = K x^n (1 + D dx/dt), where restitution is not used"
    annotation (Dialog(group="Restitution", enable=not useRestitution));

  parameter Boolean useFriction=true "= true, if bodies rub against each other"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(group="Friction"));
  parameter Types.CombinationRule frictionRule=Types.CombinationRule.GeometricMean "How friction of two materials combines"
    annotation (Evaluate=true, Dialog(group="Friction", enable=useFriction));
  parameter SI.Velocity regularisationSpeed(min=Modelica.Constants.small)=1e-3
    "Sliding speed over which friction changes its direction" annotation (Dialog(group="Friction", enable=useFriction));
  parameter SI.Velocity stribeckSpeed(min=0)=0
    "Sliding speed over which friction falls from static to sliding; 0: sliding friction at every speed"
    annotation (Dialog(group="Friction", enable=useFriction));
  parameter SI.Radius spinRadius(min=0)=0 "Radius of the areas of contact; 0: no spin friction"
    annotation (Dialog(group="Spin and rolling friction", enable=useFriction));
  parameter SI.Length rollingLever(min=0)=0 "Coefficient of rolling friction, a length; 0: none"
    annotation (Dialog(group="Spin and rolling friction"));
  parameter SI.AngularVelocity turningRegularisationSpeed(min=Modelica.Constants.small)=1e-2
    "Angular speed over which torques of friction change their direction"
    annotation (Dialog(group="Spin and rolling friction"));

  SI.Energy elasticEnergy "Energy stored in the compliance of all contacts";
  Real contactCount(unit="1") "Number of pairs of bodies that touch";
  SI.Length largestDepth "Largest penetration depth of all contacts";
  Real relativeDepth(unit="1") "Largest penetration depth by the thickness of the thinner of the two bodies";

protected
  final parameter Integer choice[6]={Integer(normalLaw),if useRestitution then 1 else 0,if stiffnessChoice == Types.StiffnessChoice.Hertz
       then 1 else 0,Integer(restitutionRule),if useFriction then 1 else 0,Integer(frictionRule)} "Choices for the engine";
  final parameter Real number[9]={exponent,steadyRate,damping,dampingDepth,regularisationSpeed,stribeckSpeed,spinRadius,
      rollingLever,turningRegularisationSpeed} "Numbers of the laws for the engine";
  final parameter SI.Mass mass[n]=inertia.m "Mass of each body; 0: immovable";
  final parameter SI.Position centre[n, 3]=Internal.Unaliased.vectors(inertia.r_CM) "Centre of mass of each body, in its frame";
  final parameter SI.Inertia tensor[n, 3, 3]=Internal.Unaliased.tensors(inertia.I)
    "Inertia of each body about its centre of mass, in the axes of its frame";
  final parameter Real planeModulus[n](each unit="Pa")=material.E ./ (ones(n) - material.nu .^ 2) "E/(1 - nu^2) of each body";
  final parameter Real curvature[n](each unit="1/m")=ones(n) ./ contactRadius "Curvature of each body's surface";
  final parameter Real restitution[n](each unit="1")=material.restitution "Coefficient of restitution of each body";
  final parameter Real muStatic[n](each unit="1")=material.muStatic "Coefficient of static friction of each body";
  final parameter Real muDynamic[n](each unit="1")=material.muDynamic "Coefficient of sliding friction of each body";
  final parameter Integer broadphase=Internal.Engine.internBroadphase(
      Internal.Engine.intern(geometry, fill(0, 0, 2), 0),
      {if mass[i] > 0 then 0 else 1 for i in 1:n},
      group,
      collidesWith,
      excluded) "Handle of the scene and its filter in the engine";
  SI.Position r_0[n, 3] "Origins of the bodies' frames";
  Real T[n, 3, 3](each unit="1") "Rotations from world to the bodies' frames";
  SI.Velocity v_0[n, 3] "Velocities of the origins";
  SI.AngularVelocity w_0[n, 3] "Angular velocities, in world axes";
  SI.Force responseForce[n, 3] "Contact force on each body, in world axes, as the engine returns it";
  SI.Torque responseTorque[n, 3] "Contact torque on each body about its frame, in world axes, as the engine returns it";
  SI.Energy responseEnergy "Elastic energy, as the engine returns it";
  Real responseCount(unit="1") "Number of pairs of bodies that touch, as the engine returns it";
  SI.Length responseDepth "Largest penetration depth, as the engine returns it";
  Real responseRelativeDepth(unit="1") "Relative depth, as the engine returns it";
equation
  (responseForce,responseTorque,responseEnergy,responseCount,responseDepth,responseRelativeDepth) = Internal.Engine.compiledResponse(
    broadphase,
    r_0,
    T,
    v_0,
    w_0,
    mass,
    centre,
    tensor,
    stiffness,
    planeModulus,
    curvature,
    restitution,
    muStatic,
    muDynamic,
    choice,
    number);
  elasticEnergy = Internal.Unaliased.scalar(responseEnergy);
  contactCount = Internal.Unaliased.scalar(responseCount);
  largestDepth = Internal.Unaliased.scalar(responseDepth);
  relativeDepth = Internal.Unaliased.scalar(responseRelativeDepth);
  assert(noEvent(relativeDepth < 0.5),
    "Two bodies are deeper in each other than half the thickness of the thinner one and may come out on the other side: take a larger stiffness, or a smaller mass or speed.",
    AssertionLevel.warning);
  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,100},{100,-100}}, lineColor={0,0,0}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,150},{150,110}}, textString="%name", textColor={0,0,255})}),
    Documentation(info="<html>
<p>
An extending model gives the poses and velocities of the bodies, <code>r_0</code>, <code>T</code>, <code>v_0</code> and <code>w_0</code>, and applies
<code>responseForce</code> and <code>responseTorque</code> to them, by functions: see <a href=\"modelica://ContactMultiBody.Internal.Unaliased\">Unaliased</a>.
</p>
</html>"));
end PartialCompiledContacts;
