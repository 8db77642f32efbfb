within ContactMultiBody.Interfaces;
partial model PartialFriction "Friction against sliding, and the force of each point"
  import SI = Modelica.Units.SI;
  extends PartialNormalForce;

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

  SI.Energy elasticEnergy "Energy stored in the compliance of all contacts";
  SI.Position anchorStretch[if friction == Types.Friction.Anchored then m else 0, 6](each start=0, each fixed=true, each nominal=1e-4)
    "Stretch of each pair's static springs: translation (1:3), turning times radius of gyration (4:6), in world axes";

protected
  SI.Force pointForce[m, pointCapacity, 3] "Force of each point on the first body";
equation
  if friction == Types.Friction.None then
    pointForce = Internal.FrictionForces.frictionlessForces(pointNormalForce, normal);
    elasticEnergy = Internal.NormalForces.springEnergy(depth, weight, stiffness, exponent);
  elseif friction == Types.Friction.Regularised then
    pointForce = Internal.FrictionForces.regularisedForces(
      depth,
      pointNormalForce,
      normal,
      pointVelocity,
      pointSpeed,
      muDynamic,
      regularisationSpeed);
    elasticEnergy = Internal.NormalForces.springEnergy(depth, weight, stiffness, exponent);
  else
    pointForce = Internal.FrictionForces.anchoredForces(
      pointNormalForce,
      normal,
      point,
      pointVelocity,
      anchorStretch,
      w_0,
      pair,
      frictionStiffness,
      muStatic,
      muDynamic,
      limitSpeed,
      frictionDampingTime,
      relaxationTime);
    der(anchorStretch) = Internal.FrictionForces.anchorRates(
      pointNormalForce,
      normal,
      point,
      pointVelocity,
      anchorStretch,
      w_0,
      pair,
      frictionStiffness,
      muStatic,
      muDynamic,
      limitSpeed,
      frictionDampingTime,
      relaxationTime);
    elasticEnergy = Internal.NormalForces.springEnergy(depth, weight, stiffness, exponent) +
      Internal.FrictionForces.anchorEnergy(anchorStretch, frictionStiffness);
  end if;
  annotation (Documentation(info="<html>
<p>
One law of <a href=\"modelica://ContactMultiBody.Friction\">Friction</a>, or none, gives the force of each point from its normal force; static springs add to the elastic energy.
</p>
</html>"));
end PartialFriction;
