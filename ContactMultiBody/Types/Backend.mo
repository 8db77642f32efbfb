within ContactMultiBody.Types;
type Backend = enumeration(
    Automatic "The engine chooses for each pair",
    Analytic "The exact algorithms of the engine",
    Libccd "libccd where it applies",
    Fcl "FCL where it applies",
    Coal "coal where it applies, in engines built with it") "Which algorithm finds the contacts"
  annotation (Documentation(info="<html>
<p>Passed to the contact engine when the scene is made. <em>Automatic</em> is right unless results of the algorithms are to be compared.</p>
<p>
<em>Libccd</em>, <em>Fcl</em> and <em>Coal</em> compute the signed distance of convex shapes. What they answer is compared
with the engine's exact algorithms, which answer instead where a library has no answer or a wrong one; half-spaces, meshes and
height fields are always the engine's. <em>Coal</em> needs an engine built with the CMake option <code>CMB_COAL</code>; others
refuse the scene with a message that says so.
</p>
</html>"));
