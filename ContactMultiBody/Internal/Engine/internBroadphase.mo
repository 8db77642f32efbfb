within ContactMultiBody.Internal.Engine;
pure function internBroadphase "Handle of a scene with the filter that tells which bodies never touch"
  extends Modelica.Icons.Function;
  input Integer scene "Handle from intern";
  input Integer fixed[:] "1 for bodies that never move, else 0";
  input Integer group[size(fixed, 1)] "Bits of the groups each body belongs to";
  input Integer collidesWith[size(fixed, 1)] "Bits of the groups each body collides with";
  input Integer excluded[:, 2] "Pairs of bodies that never touch";
  output Integer broadphase "Handle, the same for the same arguments";
external "C" broadphase = cmb_modelica_intern_broadphase(scene, fixed, size(fixed, 1), group, collidesWith, excluded, size(excluded, 1))
  annotation (
    Include="#include \"contact_multibody_scene_modelica.h\"",
    IncludeDirectory="modelica://ContactMultiBody/Resources/Include",
    LibraryDirectory="modelica://ContactMultiBody/Resources/Library",
    Library={"ContactMultiBody"});
  annotation (Documentation(info="<html>
<p>
As with <a href=\"modelica://ContactMultiBody.Internal.Engine.intern\">intern</a>, the engine keeps what it was asked for, and equal arguments
give one handle.
</p>
</html>"));
end internBroadphase;
