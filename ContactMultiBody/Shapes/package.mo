within ContactMultiBody;
package Shapes "Geometry of bodies as descriptor strings"
  extends Modelica.Icons.FunctionsPackage;

  annotation (Documentation(info="<html>
<p>
Each function returns a string that describes a shape in the frame of a body. The string is given to the
body's parameter <code>geometry</code>. Strings of several shapes are joined to one by
<a href=\"modelica://ContactMultiBody.Shapes.compound\">compound</a>. The strings follow a simple grammar and may also be
written as literals or come from a generator:
</p>
<blockquote><pre>
descriptor := shape { \";\" shape }
shape      := \"cmb/1\" kind { key \"=\" ( numbers | name ) }
numbers    := number { \",\" number }
name       := of a file, in quotation marks where it holds blanks or \";\"
</pre></blockquote>
<p>
All shapes take a position and a rotation in the frame of the body; <code>rotation</code> turns vectors from the body's
frame to the shape's, like <code>T</code> of a Modelica.Mechanics.MultiBody.Frames.Orientation.
</p>
</html>"));
end Shapes;
