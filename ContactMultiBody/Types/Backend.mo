within ContactMultiBody.Types;
type Backend = enumeration(
    Automatic "The engine chooses for each pair",
    Analytic "The exact algorithms of the engine",
    Libccd "libccd where it applies",
    Fcl "FCL where it applies",
    Coal "coal where it applies") "Which algorithm finds the contacts"
  annotation (Documentation(info="<html>
<p>Passed to the contact engine when the scene is made. <em>Automatic</em> is right unless results of the algorithms are to be compared.</p>
<p>
<em>Libccd</em>, <em>Fcl</em> and <em>Coal</em> compute the signed distance of convex shapes. What they answer counts, with their errors and
at their cost; the engine's exact algorithms answer where a library has no answer or one that contradicts itself, and for half-spaces, meshes
that are not convex and height fields. Each of the three is a module of its own, which the engine loads when a scene names it and without which
it refuses the scene with a message that says so; see <a href=\"modelica://ContactMultiBody.UsersGuide.ToolNotes\">ToolNotes</a>.
</p>
</html>"));
