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
    "Approach speed of each pair when it last was struck";
  Boolean touches[if catchImpacts then m else 0](each start=false, each fixed=true) "= true, if the bodies of the pair touch, once they were 1e-10 m deep";

protected
  final parameter Boolean isMemoryless=useRestitution and normalLaw <> Types.NormalLaw.SpringDamper and restitutionMethod
       == Types.RestitutionMethod.Memoryless "= true, if restitution is delivered without events" annotation (Evaluate=true);
  constant Real slowed(unit="1")=0.99
    "Pairs this much slower than at the first touch, where rounding may blur the normal, have been slowed down since";
  constant SI.Length settled=1e-10 "Depth from which a contact's points, normal and speed are known well";
  constant SI.Length resolved=1e-13 "Depth from which rounding does not choose the points of a face that touch first";
  SI.Velocity strikeSpeed[if catchImpacts then m else 0] "Greatest approach speed of the points where each pair touches";
  SI.Length deepest[if catchImpacts then m else 0] "Depth of each pair's deepest point";
  Boolean inContact[if catchImpacts then m else 0](each start=false, each fixed=true)
    "= true, if impactSpeed is that of the present contact, which may be shallower than touches can tell";
  Boolean isShallow[if catchImpacts then m else 0] "= true, if a pair is in contact and touches did not tell so far";
  SI.Velocity speed[if catchImpacts then m else 0] "Impact speed of the present contact before an event now; at least restSpeed";
  SI.Velocity telling[if catchImpacts then m else 0] "Jumps beyond speed where a pair is struck, or leaves a contact that is shallow";
  Boolean struck[if catchImpacts then m else 0] "= true, if a pair meets faster than in the contact so far, or a shallow contact ends";
  SI.Velocity caughtSpeed[if catchImpacts then m else 0] "Impact speed of each pair after an event now";
  Real rate[if catchImpacts then m else 0](each unit="s/m") "Damping factor by impact speed of each pair";
initial equation
  if catchImpacts then
    pre(impactSpeed) = strikeSpeed;
  end if;
equation
  if catchImpacts then
    for i in 1:m loop
      touches[i] = distance[i] < (if pre(touches[i]) then 0 else -settled);
    end for;
    strikeSpeed = Internal.Restitution.strikeSpeeds(depth, pointSpeed);
    deepest = Internal.Restitution.deepestPoints(depth);
    // Only pre() of scalars, and outside of functions: some tools pass pre() of an array as its present values.
    for i in 1:m loop
      isShallow[i] = pre(inContact[i]) and not pre(touches[i]);
    end for;
    for i in 1:m loop
      speed[i] = max(if pre(inContact[i]) then pre(impactSpeed[i]) else 0, restSpeed);
    end for;
    // Jumps where bodies meet and where they part; the relation of touches may lag by the tool's hysteresis.
    for i in 1:m loop
      telling[i] = noEvent(if isShallow[i] then (if deepest[i] > 0 then 0 else 2*speed[i])
        elseif deepest[i] > resolved then strikeSpeed[i] else 0);
    end for;
    for i in 1:m loop
      struck[i] = telling[i] > 1.25*speed[i];
    end for;
    for i in 1:m loop
      inContact[i] = if struck[i] and isShallow[i] or pre(touches[i]) and not touches[i] then false
        else pre(inContact[i]) or touches[i] or struck[i];
    end for;
    for i in 1:m loop
      caughtSpeed[i] = if struck[i] and not isShallow[i] then strikeSpeed[i]
        elseif not (touches[i] and not pre(touches[i])) or isShallow[i] and noEvent(strikeSpeed[i] < slowed*pre(impactSpeed[i]))
          then pre(impactSpeed[i]) else strikeSpeed[i];
    end for;
    when touches then
      impactSpeed = caughtSpeed;
    elsewhen struck then
      impactSpeed = caughtSpeed;
    end when;
    for i in 1:m loop
      rate[i] = NormalForce.dampingRate(dampingFactor[i], if inContact[i] then impactSpeed[i] else strikeSpeed[i], restSpeed);
    end for;
    for i in 1:m loop
      assert(noEvent(not touches[i] or strikeSpeed[i] < max(1.2*impactSpeed[i], 10*restSpeed)),
        "Pair " + String(i) + " is struck again while it touches: from 1.25 times the impact speed on that has its own damping, and results beside that threshold may depend on the tolerance. Compare with a tighter one, or take restitutionMethod=Memoryless.",
        AssertionLevel.warning);
    end for;
  end if;
  annotation (Documentation(info="<html>
<p>
The damping of a contact that delivers a restitution depends on the speed at which it began. Either events catch that speed (<code>impactSpeed</code>), or it is recovered from depth
and speed (<code>Memoryless</code>), for which <a href=\"modelica://ContactMultiBody.Interfaces.PartialNormalForce\">PartialNormalForce</a> needs the bodies' inertia.
</p>
<p>
<code>touches</code> becomes true 1e-10 m deep, where points, normal and speed are known well, and false where the bodies part; a contact may be shallower, and the relation lags by the hysteresis of
events. So a contact lasts (<code>inContact</code>) from the first touch, at which <code>strikeSpeed</code> jumps, until <code>touches</code> tells of its end or, where it never became true, the last point
leaves. Within the first 1e-13 m rounding chooses the points of a face that touch, and with them the speed; until then the present speed stands for that of the impact.
</p>
<p>
A touching pair whose approach speed exceeds 1.25 times <code>impactSpeed</code> is struck anew, by another body or by friction that jams. Results beside that threshold may depend on the tolerance; from 1.2 times on,
unless all is slower than ten times <code>restSpeed</code>, a warning says so. <code>Memoryless</code> has no threshold.
</p>
</html>"));
end PartialRestitution;
