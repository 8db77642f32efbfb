within ContactMultiBody.Types;
type NormalLaw = enumeration(
    Exact "Delivers the coefficient of restitution exactly",
    Juhasz "Juhasz 2008",
    HuntCrossley "Hunt and Crossley 1975",
    HerbertMcWhannell "Herbert and McWhannell 1977",
    LeeWang "Lee and Wang 1983",
    LankaraniNikravesh "Lankarani and Nikravesh 1990",
    Gonthier "Gonthier et al. 2004, approximation",
    Flores "Flores et al. 2011",
    HuGuo "Hu and Guo 2015",
    SpringDamper "Spring and damper in parallel, without regard to restitution") "Law of the normal force"
  annotation (Documentation(info="<html>
<p>How the damping of a contact follows from the coefficient of restitution; see the package <a href=\"modelica://ContactMultiBody.NormalForce\">NormalForce</a>.</p>
</html>"));
