within ContactMultiBody.Types;
type Backend = enumeration(
    Automatic "The engine chooses for each pair",
    Analytic "The exact algorithms of the engine",
    Libccd "libccd where it applies",
    Fcl "FCL where it applies") "Which algorithm finds the contacts"
  annotation (Documentation(info="<html>
<p>Passed to the contact engine when the scene is made. <em>Automatic</em> is right unless results of the algorithms are to be compared.</p>
</html>"));
