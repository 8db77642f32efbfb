within ContactMultiBody.Internal.Engine;
pure function intern "Handle of the scene made of the given shapes and pairs"
  extends Modelica.Icons.Function;
  input String geometry[:] "Descriptor of each body's geometry";
  input Integer pairs[:, 2] "Bodies of each pair";
  input Integer backend "0: automatic, 1: analytic, 2: libccd, 3: FCL, 4: coal";
  output Integer scene "Handle, the same for the same arguments";
external "C" scene = cmb_modelica_intern(geometry, size(geometry, 1), pairs, size(pairs, 1), backend)
  annotation (
    Include="#include \"contact_multibody_modelica.h\"",
    IncludeDirectory="modelica://ContactMultiBody/Resources/Include",
    LibraryDirectory="modelica://ContactMultiBody/Resources/Library",
    Library={"ContactMultiBody"});
  annotation (Documentation(info="<html>
<p>
The engine keeps every scene it was asked for until it is unloaded: scenes never change, equal scenes are one, and nothing
has to be freed. That makes the function pure.
</p>
</html>"));
end intern;
