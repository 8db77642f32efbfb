within ContactMultiBody.Interfaces;
partial model PartialRestitution "What an impact gives back, and the events that catch its speed"
  import SI = Modelica.Units.SI;
  extends PartialPairs;

  parameter Types.NormalLaw normalLaw=Types.NormalLaw.Exact "Law of the normal force"
    annotation (Evaluate=true, Dialog(group="Normal force"));

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

  final parameter Boolean catchImpacts=useRestitution and normalLaw <> Types.NormalLaw.SpringDamper and restitutionMethod
       == Types.RestitutionMethod.ImpactSpeed "= true, if events catch the speeds of impacts" annotation (Evaluate=true);
  final parameter Real dampingFactor[m](each unit="1")=Internal.Restitution.dampingFactors(normalLaw, restitution)
    "Damping factor of each pair";

  SI.Velocity impactSpeed[if catchImpacts then m else 0]
    "Approach speed of each pair when its contact began, or of a faster strike since then";
  Boolean touches[if catchImpacts then m else 0](each start=false, each fixed=true) "= true, if the bodies of the pair touch";

protected
  final parameter Boolean isMemoryless=useRestitution and normalLaw <> Types.NormalLaw.SpringDamper and restitutionMethod
       == Types.RestitutionMethod.Memoryless "= true, if restitution is delivered without events" annotation (Evaluate=true);
  SI.Velocity strikeSpeed[if catchImpacts then m else 0] "Greatest approach speed of the points where each pair touches";
  SI.Velocity touchSpeed[if catchImpacts then m else 0] "Approach speed of each pair when its contact began";
  SI.Velocity caughtSpeed[if catchImpacts then m else 0] "The same after an event now";
  SI.Velocity strikeExcess[if catchImpacts then m else 0](each start=0, each fixed=true)
    "What strikes since then add to it";
  SI.Velocity reachedSpeed[if catchImpacts then m else 0] "Approach speed of each pair that strikes have reached";
  Real rate[if catchImpacts then m else 0](each unit="s/m") "Damping factor by impact speed of each pair";
initial equation
  if catchImpacts then
    pre(touchSpeed) = strikeSpeed;
  end if;
equation
  if catchImpacts then
    for i in 1:m loop
      touches[i] = distance[i] < 0;
    end for;
    strikeSpeed = Internal.Restitution.strikeSpeeds(depth, pointSpeed);
    // Only pre() of scalars, and outside of functions: some tools pass pre() of an array as its present values.
    for i in 1:m loop
      caughtSpeed[i] = if touches[i] and not pre(touches[i]) then strikeSpeed[i] else pre(touchSpeed[i]);
    end for;
    when touches then
      touchSpeed = caughtSpeed;
    end when;
    for i in 1:m loop
      reachedSpeed[i] = 1.1*(max(touchSpeed[i], restSpeed) + strikeExcess[i]);
    end for;
    der(strikeExcess) = Internal.Restitution.strikeRates(touches, depth, pointSpeed, reachedSpeed, strikeExcess);
    for i in 1:m loop
      impactSpeed[i] = Internal.Restitution.impactSpeed(touchSpeed[i], reachedSpeed[i], restSpeed);
    end for;
    for i in 1:m loop
      rate[i] = NormalForce.dampingRate(dampingFactor[i], impactSpeed[i], restSpeed);
    end for;
  end if;
  annotation (Documentation(info="<html>
<p>
The damping of a contact that delivers a restitution depends on the speed at which it began. Either events catch that speed (<code>impactSpeed</code>), which then follows
<a href=\"modelica://ContactMultiBody.Internal.Restitution.strikeRates\">strikes during the contact</a>, or it is recovered from depth and speed (<code>Memoryless</code>), for which
<a href=\"modelica://ContactMultiBody.Interfaces.PartialNormalForce\">PartialNormalForce</a> needs the bodies' inertia.
</p>
</html>"));
end PartialRestitution;
