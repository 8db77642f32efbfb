within ContactMultiBody.Interfaces;
partial model PartialNormalForce "Stiffness and damping along the normal"
  import SI = Modelica.Units.SI;
  extends PartialRestitution;

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

  parameter Parts.Inertia inertia[n]=collider.inertia "Inertia of each body, if not given by collider, for Memoryless only"
    annotation (Dialog(group="Restitution", enable=restitutionMethod == Types.RestitutionMethod.Memoryless));
  parameter SI.Mass effectiveMass[m](each min=0)=fill(0, m)
    "Effective mass of each pair; 0: computed from the bodies' inertia where they touch, for Memoryless only"
    annotation (Dialog(group="Restitution", enable=restitutionMethod == Types.RestitutionMethod.Memoryless));
  parameter Real steadyRate[m](each min=0, each unit="s/m")=fill(0.5, m)
    "Damping D of each pair in F = K x^n (1 + D dx/dt), where restitution is not used"
    annotation (Dialog(group="Restitution", enable=not useRestitution));

  SI.Force normalForce[m] "Normal force of each pair, summed over its points";

protected
  final parameter SI.Mass mass[n]=inertia.m "Mass of each body; 0: immovable";
  final parameter SI.Position r_CM[n, 3]=inertia.r_CM "Centre of mass of each body, in its frame";
  final parameter Real inverseInertia[n, 3, 3](each unit="1/(kg.m2)")=Internal.Restitution.inverseTensors(inertia.I)
    "Inverse of each body's tensor of inertia, in its frame";
  final parameter Real logarithmAtSeparation[m](each unit="1")=Internal.Restitution.logarithmsAtSeparation(dampingFactor)
    "ln(1 - d e) of each pair";
  SI.Acceleration springDeceleration[if isMemoryless then m else 0, pointCapacity]
    "Deceleration of each point that touches by the springs of its pair";
  SI.Force pointNormalForce[m, pointCapacity] "Normal force of each point";
equation
  if isMemoryless then
    for i in 1:m loop
      assert(effectiveMass[i] > 0 or mass[pair[i, 1]] > 0 or mass[pair[i, 2]] > 0,
        "Restitution without events needs masses: give the manager inertia={body1.inertia, ...} or effectiveMass.");
    end for;
  end if;

  if normalLaw == Types.NormalLaw.SpringDamper then
    pointNormalForce = Internal.NormalForces.springDamperForces(depth, weight, pointSpeed, stiffness, exponent, damping, dampingDepth);
  elseif catchImpacts then
    pointNormalForce = Internal.NormalForces.normalForces(depth, weight, pointSpeed, stiffness, exponent, rate);
  elseif isMemoryless then
    springDeceleration = Internal.Restitution.springDecelerations(
      depth,
      weight,
      normal,
      point,
      stiffness,
      exponent,
      pair,
      {frame[i].r_0 for i in 1:n},
      {frame[i].R.T for i in 1:n},
      mass,
      r_CM,
      inverseInertia,
      effectiveMass);
    pointNormalForce = Internal.NormalForces.memorylessForces(
      depth,
      weight,
      pointSpeed,
      stiffness,
      exponent,
      springDeceleration,
      dampingFactor,
      logarithmAtSeparation);
  else
    pointNormalForce = Internal.NormalForces.normalForces(depth, weight, pointSpeed, stiffness, exponent, steadyRate);
  end if;
  normalForce = Internal.Resultants.pairNormalForces(pointNormalForce);
  annotation (Documentation(info="<html>
<p>
One law of <a href=\"modelica://ContactMultiBody.NormalForce\">NormalForce</a> at every point of every pair: a spring and damper, or a spring whose damping delivers the restitution,
or one with the constant rate <code>steadyRate</code>.
</p>
</html>"));
end PartialNormalForce;
