within ContactMultiBody.Types;
type RestitutionMethod = enumeration(
    ImpactSpeed "Caught by an event when the contact starts",
    Memoryless "Recovered from depth and speed; no event") "How the speed at the start of a contact is known"
  annotation (Documentation(info="<html>
<p>The laws of impact need the speed v<sub>0</sub> at which a contact started. It is either caught by an event or recovered from the present depth and speed, for which the effective mass of the pair has to be known; see <a href=\"modelica://ContactMultiBody.NormalForce.memorylessSpeedRatio\">memorylessSpeedRatio</a>.</p>
</html>"));
