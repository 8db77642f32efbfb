within Modelica.Math;
function log "Natural logarithm"
  extends Modelica.Icons.Function;
  input Real u "Number";
  output Real y "Natural logarithm of u";

  external "builtin" y = log(u);
  annotation (Documentation(info="<html><p>The built-in function <code>log</code> under its qualified name.</p></html>"));
end log;
