within ContactMultiBody.Internal;
package Unaliased "Values under another name that no tool merges with the first"
  extends Modelica.Icons.InternalPackage;

  annotation (Documentation(info="<html>
<p>
Some tools replace a variable that a plain equation equates with another everywhere, also among the results of a function with several results and in arrays that are arguments,
which then lose dimensions of size 1 or are no longer understood. An equation with one of these functions, which are not inlined, keeps the two apart. The rules the library follows:
</p>
<ul>
<li>What a function with several results gives goes into variables that are arguments of functions and nothing else.</li>
<li>No element of an array that is an argument or a result is equated with another variable; a sum over one element is such an equation, too, and so is a product
with a constant that may be 1 or -1.</li>
<li>No <code>pre()</code> of a whole array is an argument.</li>
<li>Functions of arrays that equations call have <code>Inline=false</code>.</li>
</ul>
<p>
Variables that users read are therefore results of functions with one result.
</p>
</html>"));
end Unaliased;
